// Contacts of hosts in C: laws and choices by their names in model files.
#include <initializer_list>

#include "osculate/embed/c_call.hpp"
#include "osculate/embed/c_handles.hpp"
#include "osculate/embed/c_settings.hpp"
#include "osculate/embed/laws.hpp"

namespace osculate::embed {
namespace {

/// The law of a slot, begun if there is none. Throws Refused where another one is there.
template <class Law>
NamedLaw& begun(Law& slot, const LawKey& key, const char* group) {
  auto* const law = std::get_if<NamedLaw>(&slot);
  if (law == nullptr) return slot.template emplace<NamedLaw>(NamedLaw{key.law, {}, {}});
  if (law->law != key.law)
    throw Refused(
        fmt::format("{}: {} is chosen already, and {} is another law; choose it by its "
                    "word first",
                    group, law->law, key.law));
  return *law;
}

void put_number(NamedLaw& law, const LawKey& key, const NumberSetting& by,
                std::span<const double> values) {
  if (key.table) {
    by.expect_rows(2);
    law.points.clear();
    for (std::size_t i = 0; i < values.size(); i += 2)
      law.points.push_back({values[i], values[i + 1]});
    return;
  }
  for (auto& [name, value] : law.numbers)
    if (name == key.number) return void(value = by.number());
  law.numbers.emplace_back(key.number, by.number());
}

/// The numbers of all laws of a group. A law that was chosen as a struct, or none, gives way.
template <class Law>
void set_law_numbers(Law& slot, const char* group, const std::vector<LawKey>& keys,
                     NumberSetting& by) {
  for (const LawKey& key : keys)
    by.when(fmt::format("{}.{}", group, key.path), [&](std::span<const double> values) {
      Law changed = slot;
      put_number(begun(changed, key, group), key, by, values);
      slot = std::move(changed);
    });
}
template <class Law>
void set_law_numbers(std::optional<Law>& slot, const char* group, const std::vector<LawKey>& keys,
                     NumberSetting& by) {
  Law law = slot.value_or(Law{});
  bool changed = false;
  for (const LawKey& key : keys)
    by.when(fmt::format("{}.{}", group, key.path), [&](std::span<const double> values) {
      put_number(begun(law, key, group), key, by, values);
      changed = true;
    });
  if (changed) slot = std::move(law);
}

template <int Dim>
void set_sampling_numbers(Sampling& s, NumberSetting& by) {
  const auto points = [&](Sampling::Rule rule) {
    return [&by, &s, rule](std::span<const double>) {
      const int count = (by.expect(1), by.whole());
      s.rule = rule;
      s.points = count;
    };
  };
  by.when("sampling.gauss", points(Sampling::Rule::gauss));
  by.when("sampling.lobatto", points(Sampling::Rule::lobatto));
  by("sampling.subdomains", s.subdomains);
}

template <int Dim>
void set_edge_numbers(Contact<Dim>& c, NumberSetting& by) {
  by.when("edges", [&](std::span<const double>) {
    const bool wanted = by.yes();
    c.edge_angle.reset();
    if (wanted) c.edge_angle = std::numbers::pi / 6;  // as in model files
  });
  by.when("edges.angle",
          [&](std::span<const double>) { c.edge_angle = by.number() * std::numbers::pi / 180.0; });
}

template <int Dim>
void set_tangent_numbers(TangentForm& t, NumberSetting& by) {
  for (const auto& [name, part] :
       std::initializer_list<std::pair<const char*, bool*>>{{"tangent.main", &t.main},
                                                            {"tangent.rotational", &t.rotational},
                                                            {"tangent.curvature", &t.curvature}})
    by.when(name, [&by, &t, part = part](std::span<const double>) {
      *part = by.yes();
      t.consistent = false;
    });
}

void set_factors(std::vector<PenaltyFactors>& factors, NumberSetting& by) {
  by.when("factors", [&](std::span<const double> values) {
    by.expect_rows(2);
    factors.clear();
    for (std::size_t i = 0; i < values.size(); i += 2)
      factors.push_back({values[i], values[i + 1]});
  });
}

template <int Dim>
void set_contact_numbers(Contact<Dim>& c, std::array<double, 2>& offset, NumberSetting& by) {
  set_law_numbers(c.normal, "normal", law_keys(c.normal), by);
  set_law_numbers(c.damping, "normal.damping", law_keys(DampingLaw{}), by);
  by("normal.tolerance", c.tolerance);
  set_law_numbers(c.friction, "friction", law_keys(FrictionLaw{}), by);
  set_sampling_numbers<Dim>(c.sampling, by);
  set_edge_numbers(c, by);
  set_tangent_numbers<Dim>(c.tangent, by);
  set_factors(c.factors, by);
  by("offset.master", offset[0]), by("offset.slave", offset[1]);
  by("smoothing.angle", Degrees{c.smoothing.sharp_angle});
  by("search.depth", c.depth), by("search.distance", c.search_distance);
  by("area.thickness", c.area.thickness), by("area.axisymmetric", c.area.axisymmetric);
  by("reentrant_vertices", c.reentrant_vertices), by("part", c.part);
  c.offset = offset[0] + offset[1];
}

// ---- words --------------------------------------------------------------------------------------

/// Gives the choice with a name the value of a word.
class WordSetting {
 public:
  WordSetting(std::string_view key, std::string_view word) : key_(key), word_(word) {}

  /// `words` in the order of the choice's values.
  template <class Choice>
  void operator()(const char* name, Choice& choice, std::initializer_list<const char*> words) {
    known_.emplace_back(name);
    if (name != key_) return;
    found_ = true;
    choice = static_cast<Choice>(number_of({words.begin(), words.end()}));
  }
  /// A law, without its numbers; where there may be none, by the word `none`.
  template <class Law>
  void law(const char* name, Law& slot) {
    choose(name, false, law_keys(slot), [&](const std::string& law) {
      slot = NamedLaw{law, {}, {}};
    });
  }
  template <class Law>
  void law(const char* name, std::optional<Law>& slot) {
    choose(name, true, law_keys(Law{}), [&](const std::string& law) {
      slot.reset();
      if (law != "none") slot = NamedLaw{law, {}, {}};
    });
  }
  void check() const {
    if (!found_) throw Refused(core::unknown_name_message("choice", key_, known_));
  }

 private:
  [[nodiscard]] std::size_t number_of(const std::vector<std::string>& words) const {
    const auto at = std::find(words.begin(), words.end(), word_);
    if (at == words.end())
      throw Refused(fmt::format("{}: {}", key_, core::unknown_name_message("word", word_, words)));
    return static_cast<std::size_t>(at - words.begin());
  }
  template <class Use>
  void choose(const char* name, bool with_none, const std::vector<LawKey>& keys, const Use& use) {
    known_.emplace_back(name);
    if (name != key_) return;
    found_ = true;
    std::vector<std::string> words;
    if (with_none) words.emplace_back("none");
    for (const LawKey& key : keys)
      if (words.empty() || words.back() != key.law) words.push_back(key.law);
    use(words[number_of(words)]);
  }

  std::string_view key_, word_;
  std::vector<std::string> known_;
  bool found_ = false;
};

template <int Dim>
void set_contact_words(Contact<Dim>& c, WordSetting& by) {
  by.law("normal", c.normal);
  by.law("normal.damping", c.damping);
  by("normal.separation", c.separation, {"allowed", "no_separation", "tied_normal", "tied"});
  by("normal.initial_gap", c.keep_gap, {"close", "keep"});
  by.law("friction", c.friction);
  by("sampling", c.sampling.rule, {"nodes", "gauss", "lobatto", "mortar"});
  by("enforcement", c.enforcement, {"penalty", "augmented_lagrange", "lagrange_multiplier"});
  by("weight", c.weight, {"node", "reference_area", "current_area"});
  by("initial", c.overlap, {"ignore", "ramp", "keep"});
  by("history", c.history, {"continuous", "chord", "per_facet"});
  by("residual", c.residual, {"surface", "full"});
  by("tangent", c.tangent.consistent, {"covariant", "consistent"});
  by("smoothing", c.smoothing.kind, {"none", "hermite", "nurbs"});
}

template <class Side>
void set_side(osculate_contact& contact, const osculate_surface& surface, const Side& side) {
  std::visit(
      [&]<int Dim>(Contact<Dim>& c) {
        const auto* const own = std::get_if<Surface<Dim>>(&surface.value);
        if (own == nullptr)
          throw Refused(fmt::format(
              "a surface of dimension {} is none of a contact of dimension {}", 5 - Dim, Dim));
        side(c, *own);
      },
      contact.value);
}

}  // namespace
}  // namespace osculate::embed

using namespace osculate;
using embed::answered;
using embed::given;

osculate_status osculate_contact_create(int dimension, osculate_contact** out) {
  return answered([&] {
    if (embed::plane(dimension))
      embed::hand_out(osculate_contact{Contact<2>{}}, out);
    else
      embed::hand_out(osculate_contact{Contact<3>{}}, out);
  });
}
void osculate_contact_free(osculate_contact* contact) { delete contact; }

osculate_status osculate_contact_set_master(osculate_contact* contact,
                                            const osculate_surface* master) {
  return answered([&] {
    embed::set_side(given(contact, "contact"), given(master, "master"),
                    [](auto& c, const auto& surface) { c.master = surface; });
  });
}
osculate_status osculate_contact_set_slave(osculate_contact* contact,
                                           const osculate_surface* slave) {
  return answered([&] {
    embed::set_side(given(contact, "contact"), given(slave, "slave"),
                    [](auto& c, const auto& surface) { c.slave = surface; });
  });
}

osculate_status osculate_contact_set_list(osculate_contact* contact, const char* key,
                                          const double* values, std::size_t count) {
  return answered([&] {
    osculate_contact& to = given(contact, "contact");
    embed::NumberSetting by(&given(key, "key"), embed::array(values, count, "values"));
    std::visit([&](auto& c) { embed::set_contact_numbers(c, to.offset, by); }, to.value);
    by.check("key");
  });
}
osculate_status osculate_contact_set(osculate_contact* contact, const char* key, double value) {
  return osculate_contact_set_list(contact, key, &value, 1);
}

osculate_status osculate_contact_set_word(osculate_contact* contact, const char* key,
                                          const char* word) {
  return answered([&] {
    embed::WordSetting by(&given(key, "key"), &given(word, "word"));
    std::visit([&](auto& c) { embed::set_contact_words(c, by); }, given(contact, "contact").value);
    by.check();
  });
}
