#include "osculate/deck/parse.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "osculate/core/text.hpp"
#include "osculate/deck/inp_translate.hpp"
#include "osculate/deck/model_spec.hpp"
#include "osculate/deck/parse_parts.hpp"
#include "osculate/deck/scalar.hpp"
#include "osculate/io/gmsh.hpp"

namespace osculate::deck {
namespace {

template <class T>
const T* find_named(const std::vector<T>& list, const std::string& name) {
  const auto found = std::find_if(list.begin(), list.end(),
                                  [&](const T& item) { return item.name.value == name; });
  return found == list.end() ? nullptr : &*found;
}

void require_document(const SourceNode& root, const std::string& file) {
  if (root.kind == SourceNode::Kind::nothing)
    throw core::InputError({file, 0, ""}, "the file is empty; a model begins with `osculate: 1`");
  if (root.kind != SourceNode::Kind::map)
    throw core::InputError({file, root.line, ""},
                           "expected a map that begins with `osculate: 1`, got " + describe(root));
}

}  // namespace

Vec2 point_of(const Value& v) { return {v.items[0].number, v.items[1].number}; }

Vec3 place_of(const Value& v) {
  return {v.items[0].number, v.items[1].number, v.items.size() > 2 ? v.items[2].number : 0.0};
}

Marked<std::vector<Vec2>> points_of(const Value& v) {
  Marked<std::vector<Vec2>> points{{}, v.mark};
  for (const Value& item : v.items) {
    const Vec2 point = point_of(item);
    if (!points.value.empty() && points.value.back() == point)
      throw core::InputError(item.mark, "the point coincides with the one before it");
    points.value.push_back(point);
  }
  return points;
}

Marked<std::vector<double>> numbers_of(const Value& v) {
  Marked<std::vector<double>> numbers{{}, v.mark};
  for (const Value& item : v.items) numbers.value.push_back(item.number);
  return numbers;
}

std::string quoted(const std::string& text) { return "'" + printable(text) + "'"; }

const core::SourceMark& Material::mark(std::string_view parameter) const {
  for (const auto& [key, where] : marks)
    if (key == parameter) return where;
  return law.mark;
}

std::vector<const Equation*> Description::all_equations() const {
  std::vector<const Equation*> all;
  for (const Equation& one : equations) all.push_back(&one);
  for (const Step& step : steps)
    for (const Equation& one : step.equations) all.push_back(&one);
  return all;
}
const Material* Description::find_material(const std::string& name) const {
  return find_named(materials, name);
}
const Rigid* Description::find_rigid(const std::string& name) const {
  return find_named(rigid, name);
}
const Contact* Description::find_contact(const std::string& name) const {
  if (const Contact* const found = find_named(contact, name)) return found;
  for (const Contact& c : contact) {  // a pair that is made later: NAME.A-B
    const std::string prefix = c.name.value + ".";
    if (c.all && name.starts_with(prefix) && name.find('-', prefix.size()) != std::string::npos)
      return &c;
  }
  return nullptr;
}
const Amplitude* Description::find_amplitude(const std::string& name) const {
  return find_named(amplitudes, name);
}

Description parse_model(std::string_view text, std::string file_name,
                        std::span<const Setting> settings) {
  SourceNode root = read_yaml(text, file_name);
  return parse_model(std::move(root), std::move(file_name), settings);
}

Description parse_model(SourceNode root, std::string file_name, std::span<const Setting> settings) {
  require_document(root, file_name);
  Description d;
  d.parameters = apply_parameters(root, file_name, settings);
  const BoundKeys<Description> keys = model_keys();
  Value model = check(model_spec(keys), root, file_name);
  std::vector<SetDefinition> unions;
  name_unions(model, unions);
  d.file = std::move(file_name);
  keys.read(model, d);
  for (SetDefinition& one : unions)
    if (!find_named(d.sets, one.name.value)) d.sets.push_back(std::move(one));
  check_dimension(d);
  check_references(d);
  check_steps(d);
  complete_output(d);
  d.source = source_leaves(root, {"title", "solver", "output", "parameters"});
  return d;
}

namespace {

Description read_deck(const std::string& path, std::span<const Setting> settings) {
  const std::string content = io::read_file(path);
  TranslatedDeck deck = translate_deck(content, path);
  Description d = parse_model(std::move(deck.root), path, settings);
  d.notes = std::move(deck.notes);
  d.check_only = deck.check_only;
  return d;
}

/// A mesh or a drawing in place of a model file: what is done with it.
void refuse_other_files(const std::string& path, std::string_view text) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::ranges::transform(ending, ending.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto refuse = [&](const std::string& what) {
    throw core::InputError({path, 0, ""}, "is no model file: it is " + what);
  };
  if (text.starts_with("$MeshFormat"))
    refuse(fmt::format("a mesh of Gmsh; `osculate init {}` writes a model file for it", path));
  if (text.starts_with("osculate:") || text.find("\nosculate:") != std::string_view::npos) return;
  if (ending == ".geo")
    refuse(
        fmt::format("a geometry of Gmsh; mesh it (`gmsh -3 {}`, in the plane -2), then `osculate "
                    "init` writes a model file for the mesh",
                    path));
  if (ending == ".step" || ending == ".stp" || ending == ".iges" || ending == ".igs")
    refuse(
        "a drawing; mesh it, in Gmsh for example, then `osculate init` writes a model file for "
        "the mesh");
}

}  // namespace

Description read_model(const std::string& path, std::span<const Setting> settings) {
  std::error_code ignored;
  if (names_a_deck(path)) return read_deck(path, settings);
  if (std::filesystem::is_directory(path, ignored))
    throw core::InputError({path, 0, ""}, "cannot be read: it is a folder");
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    const int reason = errno;
    throw core::InputError({path, 0, ""}, fmt::format("cannot be read: {}", std::strerror(reason)));
  }
  // One byte more than allowed is enough to be refused; a device may never end.
  std::string text(TextLimits{}.bytes + 1, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  refuse_other_files(path, text);
  return parse_model(text, path, settings);
}

core::InputError unknown_set(const Name& on, std::span<const std::string> sets) {
  return {on.mark, core::unknown_name_message("set", printable(on.value), sets)};
}

}  // namespace osculate::deck
