// The survey of a domain as text, JSON, ParaView file and report page.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "osculate/core/version.hpp"
#include "osculate/io/report.hpp"
#include "osculate/io/vtk.hpp"
#include "osculate/result/domain_picture.hpp"
#include "osculate/result/report_json.hpp"
#include "osculate/result/result_folder.hpp"

namespace osculate::result {
namespace {

std::string length_text(double value) {
  return std::isfinite(value) ? fmt::format("{:.6g}", value) : std::string("without end");
}

std::string limit_text(const DomainLimit& limit, bool with_kind) {
  if (!std::isfinite(limit.value)) return length_text(limit.value);
  std::string text = length_text(limit.value);
  if (with_kind) text += ", " + limit.limit;
  text += " at " + text_of(limit.at);
  if (limit.limit == "bottleneck") text += " and " + text_of(limit.other);
  return text;
}

/// What is certain of the reach: found from above, proved from below.
std::string proved_text(const DomainSide& side, double tolerance) {
  const double found = side.reach.value, least = side.proved;
  if (found <= 0) return "reach is 0: an edge or corner opens to the other side";
  if (least >= found) return "reach is " + length_text(found);
  if (!(least > 0)) return fmt::format("no reach: {}", side.unproved);
  const std::string range = std::isfinite(found)
                                ? fmt::format("reach between {:.6g} and {:.6g}", least, found)
                                : fmt::format("reach at least {:.6g}", least);
  if (side.unproved.empty()) return range + fmt::format(" (within {:.3g} %)", 100 * tolerance);
  return range + fmt::format(" (wider than {:.3g} %: {})", 100 * tolerance, side.unproved);
}

std::string side_text(std::string_view name, const DomainSide& side, double tolerance) {
  return fmt::format(
      "{}\n  smallest 1/k  {}\n  bottleneck/2  {}\n  reach         {}\n  proved        {}\n", name,
      limit_text(side.curvature, false), limit_text(side.bottleneck, false),
      limit_text(side.reach, true), proved_text(side, tolerance));
}

std::string kink_text(std::string_view name, const DomainKinks& kinks) {
  if (kinks.count == 0) return fmt::format("{} none", name);
  return fmt::format("{} {} (largest angle {:.4g} degrees at {})", name, kinks.count, kinks.largest,
                     text_of(kinks.at));
}

nlohmann::json number(double v) {
  return std::isfinite(v) ? nlohmann::json(v) : nlohmann::json(nullptr);
}
nlohmann::json place_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
nlohmann::json limit_json(const DomainLimit& limit) {
  nlohmann::json out{{"value", number(limit.value)}, {"limit", limit.limit}};
  if (!std::isfinite(limit.value)) return out;
  out["at"] = place_json(limit.at);
  out["other"] = place_json(limit.other);
  return out;
}
nlohmann::json side_json(const DomainSide& side) {
  return {{"curvature", limit_json(side.curvature)},
          {"bottleneck", limit_json(side.bottleneck)},
          {"reach", limit_json(side.reach)},
          {"proved", number(side.proved)},
          {"unproved", side.unproved}};
}
nlohmann::json kinks_json(const DomainKinks& kinks) {
  nlohmann::json out{{"count", kinks.count}, {"largest_degrees", kinks.largest}};
  if (kinks.count > 0) out["at"] = place_json(kinks.at);
  return out;
}

/// Point arrays: name and member.
struct PlaceArray {
  std::string_view name;
  double DomainPlace::*slot;
};
constexpr std::array<PlaceArray, 10> arrays{{{"K1", &DomainPlace::larger},
                                             {"K2", &DomainPlace::smaller},
                                             {"GAUSS", &DomainPlace::gauss},
                                             {"MEAN", &DomainPlace::mean},
                                             {"CLASS", &DomainPlace::point_class},
                                             {"BOUND_ABOVE", &DomainPlace::bound_above},
                                             {"BOUND_BELOW", &DomainPlace::bound_below},
                                             {"EVEN_ABOVE", &DomainPlace::even_above},
                                             {"EVEN_BELOW", &DomainPlace::even_below},
                                             {"SINE", &DomainPlace::sine}}};

}  // namespace

std::string text_of(const Vec3& p) {
  const double zero = 1e-9 * p.norm();
  const auto tidy = [&](double v) { return std::abs(v) <= zero ? 0.0 : v; };
  return fmt::format("({:.5g}, {:.5g}, {:.5g})", tidy(p.x()), tidy(p.y()), tidy(p.z()));
}

std::string to_text(const DomainReport& r) {
  std::string text = fmt::format("{}: {} {} in {}, size {:.6g}\n", r.surface, r.pieces,
                                 r.pieces == 1 ? "smooth piece" : "smooth pieces",
                                 r.dimension == 2 ? "the plane" : "space", r.size);
  text += fmt::format("classes of {} places:", r.places);
  for (const auto& [name, count] : r.classes) text += fmt::format(" {} {},", name, count);
  text.back() = '\n';
  for (const FlatPlace& flat : r.flat)
    text += fmt::format("planar point at {}: its terms of third order vanish along {}\n",
                        text_of(flat.at), flat.form == "zero" ? "all lines" : flat.form);
  text += side_text("above (to where the normals point)", r.above, r.tolerance);
  text += side_text("below", r.below, r.tolerance);
  text += fmt::format("{}; {}; borders {}\n", kink_text("convex edges", r.ridges),
                      kink_text("re-entrant", r.valleys), r.borders);
  for (const std::string& warning : r.warnings) text += "warning: " + warning + "\n";
  return text;
}

std::string to_json(const DomainReport& r) {
  nlohmann::json classes = nlohmann::json::object(), flat = nlohmann::json::array();
  for (const auto& [name, count] : r.classes) classes[name] = count;
  for (const FlatPlace& f : r.flat) flat.push_back({{"at", place_json(f.at)}, {"form", f.form}});
  return json_text({{"surface", r.surface},
                    {"dimension", r.dimension},
                    {"size", r.size},
                    {"pieces", r.pieces},
                    {"borders", r.borders},
                    {"places", r.places},
                    {"classes", classes},
                    {"planar_points", flat},
                    {"above", side_json(r.above)},
                    {"below", side_json(r.below)},
                    {"convex", kinks_json(r.ridges)},
                    {"reentrant", kinks_json(r.valleys)},
                    {"tolerance", r.tolerance},
                    {"smallest_sine", r.smallest_sine},
                    {"warnings", r.warnings}},
                   1);
}

void write_domain(const std::string& path, const DomainPicture& picture) {
  std::vector<io::Field> points, cells;
  for (const PlaceArray& array : arrays) {
    std::vector<double> values;
    for (const DomainPlace& place : picture.places) values.push_back(place.*array.slot);
    points.push_back(io::scalar_field(std::string(array.name), std::move(values)));
  }
  std::vector<double> parts, pieces;
  for (std::size_t b = 0; b < picture.blocks.size(); ++b) {
    for (const DomainPart part : picture.parts[b]) parts.push_back(static_cast<double>(part));
    for (const Index piece : picture.pieces[b]) pieces.push_back(piece);
  }
  cells.push_back(io::scalar_field("PART", std::move(parts)));
  cells.push_back(io::scalar_field("PIECE", std::move(pieces)));
  io::write_vtu(path, {picture.points, picture.blocks, points, cells});
}

std::string domain_html(const DomainReport& r) {
  const DomainPicture& p = r.picture;
  const bool plane = r.dimension == 2;  // then with the borders of the domain
  nlohmann::json cells = nlohmann::json::array();
  for (std::size_t b = 0; b < p.blocks.size(); ++b) {
    const auto nodes = static_cast<std::size_t>(cell::info(p.blocks[b].type).nodes);
    std::vector<Index> shown;
    for (std::size_t c = 0; c < p.parts[b].size(); ++c)
      if (plane || p.parts[b][c] == DomainPart::surface)
        shown.insert(shown.end(), p.blocks[b].cell(static_cast<Index>(c)),
                     p.blocks[b].cell(static_cast<Index>(c)) + nodes);
    if (!shown.empty())
      cells.push_back(
          {{"type", cell::info(p.blocks[b].type).name}, {"connectivity", std::move(shown)}});
  }
  const std::size_t n = p.points.size();
  const auto vectors_of = [&](const auto& get) {
    return plane ? vectors<2>(n, [&](std::size_t i) { return Vec2(get(i).template head<2>()); })
                 : vectors<3>(n, get);
  };
  nlohmann::json fields = nlohmann::json::object();
  for (const PlaceArray& array : arrays)
    fields[std::string(array.name)] =
        scalars(n, [&](std::size_t i) { return p.places[i].*array.slot; });
  nlohmann::json mesh{{"dimension", r.dimension},
                      {"points", vectors_of([&](std::size_t i) { return p.points[i]; })},
                      {"cells", cells}};
  nlohmann::json frame{
      {"step", "surface"}, {"increment", 1},
      {"time", 0},         {"u", vectors_of([](std::size_t) { return Vec3(Vec3::Zero()); })},
      {"fields", fields},  {"contact", nlohmann::json::array()}};
  nlohmann::json rows = nlohmann::json::array();
  const auto add = [&](const std::string& name, const std::string& text) {
    rows.push_back({name, text});
  };
  for (const auto& [name, count] : r.classes) add(name, fmt::format("{} places", count));
  for (const auto& [name, side] : {std::pair("above", &r.above), std::pair("below", &r.below)}) {
    add(fmt::format("smallest 1/k {}", name), limit_text(side->curvature, false));
    add(fmt::format("bottleneck/2 {}", name), limit_text(side->bottleneck, false));
    add(fmt::format("reach {}", name), limit_text(side->reach, true));
    add(fmt::format("proved {}", name), proved_text(*side, r.tolerance));
  }
  add("edges", kink_text("convex", r.ridges) + "; " + kink_text("re-entrant", r.valleys));
  for (const std::string& warning : r.warnings) add("warning", warning);
  const nlohmann::json page{{"title", "Projection domain of " + r.surface},
                            {"osculate", core::version},
                            {"status", "done"},
                            {"model", {{{"heading", "Domain"}, {"rows", rows}}}},
                            {"mesh", mesh},
                            {"frames", {frame}}};
  return io::report_html(json_text(page));
}

}  // namespace osculate::result
