#include "osculate/result/answer_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "osculate/body/rigid_body.hpp"
#include "osculate/io/dat.hpp"
#include "osculate/model/bulk.hpp"
#include "osculate/model/quantities.hpp"
#include "osculate/result/answer_sums.hpp"
#include "osculate/solid/energy.hpp"

namespace osculate::result {
namespace {

using deck::Answer;
using deck::Totals;

constexpr double sector_of_ring = 1.0 / 180;

bool is_ring(const solid::Section<2>& section) {
  return section.assumption == solid::Assumption::axisymmetric;
}
bool is_ring(const solid::Section<3>&) { return false; }

/// As the deck spells it: an ending that tells sets of one name apart is ours.
std::string name_in_deck(const deck::AnswerRequest& request) {
  if (request.on.empty()) return "all";
  std::string name = request.on[0].value;
  for (const std::string_view ending : {".nodes", ".cells", ".surface"})
    if (name.ends_with(ending)) name.erase(name.rfind(ending));
  std::ranges::transform(name, name.begin(), [](char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c;
  });
  return name;
}

template <int Dim>
struct Tables {
  const AnswerModel<Dim>& a;
  const model::BasicSystem<Dim>& system;
  const model::BasicState<Dim>& state;
  const deck::AnswerRequest& request;
  double time;
  std::string name = name_in_deck(request);
  std::string out{};

  void title(std::string_view what) {
    out += io::dat_title(fmt::format("{} for set {} and", what, name), time);
  }
  [[nodiscard]] const mesh::Set* set() const {
    return request.on.empty() ? nullptr : a.model.mesh.find_set(request.on[0].value);
  }

  [[nodiscard]] std::vector<Index> nodes() const {
    if (!set()) return a.mesh.nodes;
    std::vector<Index> list = set()->nodes;
    std::ranges::sort(list, {},
                      [&](Index n) { return a.node_number[static_cast<std::size_t>(n)]; });
    return list;
  }

  /// Cells of `a.mesh` that are in the set, and there in this step.
  [[nodiscard]] std::vector<std::size_t> cells() const {
    std::vector<std::size_t> list;
    std::vector<std::vector<char>> wanted;
    for (const mesh::Block& block : a.model.mesh.blocks)
      wanted.emplace_back(static_cast<std::size_t>(block.size()), set() ? 0 : 1);
    if (set())
      for (const mesh::CellRef& ref : set()->cells)
        wanted[static_cast<std::size_t>(ref.block)][static_cast<std::size_t>(ref.cell)] = 1;
    for (std::size_t c = 0; c < a.mesh.cells.size(); ++c) {
      const mesh::CellRef& ref = a.mesh.cells[c].ref;
      if (wanted[static_cast<std::size_t>(ref.block)][static_cast<std::size_t>(ref.cell)] != 0 &&
          !a.place_in(system.model(), c).memory.removed)
        list.push_back(c);
    }
    return list;
  }

  // ---- nodes ----------------------------------------------------------------------------------

  /// The body that a node stands for.
  [[nodiscard]] const deck::BodyNode* body_at(Index node) const {
    const auto found = a.built.body_nodes.find(node);
    return found == a.built.body_nodes.end() ? nullptr : &found->second;
  }

  /// Rotations and moments in space: about z in the plane.
  [[nodiscard]] static Vec3 turning(const Vec<body::motions<Dim>>& motions) {
    Vec3 out = Vec3::Zero();
    out.tail<body::rotations<Dim>>() = motions.template tail<body::rotations<Dim>>();
    return out;
  }

  [[nodiscard]] Vec3 displacement(Index node) const {
    if (const deck::BodyNode* const of = body_at(node); of && of->rotation) {
      Vec<body::motions<Dim>> motions = Vec<body::motions<Dim>>::Zero();
      motions.template tail<body::rotations<Dim>>() =
          body::total_rotation(state.rigid[static_cast<std::size_t>(of->body)]);
      return turning(motions);
    }
    return a.displacement(state.u, node);
  }

  /// Of a node that stands for a rigid body what acts on all of it.
  [[nodiscard]] Vec3 force(const Eigen::VectorXd& of_nodes, Index node) const {
    const deck::BodyNode* const of = body_at(node);
    if (!of) return a.force(of_nodes, node);
    const Vec<body::motions<Dim>> sum =
        model::force_on_body(system, a.model, state, of->body, of_nodes);
    if (of->rotation) return a.sector * turning(sum);
    Vec3 out = Vec3::Zero();
    out.template head<Dim>() = a.sector * sum.template head<Dim>();
    return out;
  }

  /// A row of a node, along its own axes where these are asked for.
  void row(Index node, Vec3 value) {
    const auto found = a.built.node_axes.find(node);
    const bool local = request.local && found != a.built.node_axes.end();
    if (local) {
      const Vec<Dim> turned = found->second.transpose() * value.template head<Dim>();
      value.template head<Dim>() = turned;
    }
    io::append_dat_row(out, a.node_number[static_cast<std::size_t>(node)], 0, {value.data(), 3});
    if (local) out.insert(out.size() - 1, " L");
  }

  void displacements() {
    if (request.totals == Totals::only) return;
    title("displacements (vx,vy,vz)");
    for (const Index n : nodes()) row(n, displacement(n));
  }

  void forces() {
    Vec3 sum = Vec3::Zero();
    if (request.totals != Totals::only) title("forces (fx,fy,fz)");
    const Eigen::VectorXd of_nodes = model::nodal_forces(system);
    for (const Index n : nodes()) {
      const Vec3 of_node = force(of_nodes, n);
      sum += of_node;
      if (request.totals != Totals::only) row(n, of_node);
    }
    if (request.totals == Totals::none) return;
    title("total force (fx,fy,fz)");
    io::append_dat_total(out, {sum.data(), 3});
  }

  // ---- cells ----------------------------------------------------------------------------------

  /// Calls `of(section, type, reference, displacement, memory)` for a cell.
  template <class Of>
  [[nodiscard]] auto at_cell(std::size_t cell, const Of& of) const {
    const auto [section, place] = a.place_in(system.model(), cell);
    const model::CellNodes c = model::cell_nodes(a.model.mesh, a.mesh.cells[cell].ref);
    const material::Memory memory = place.of(state.memory);
    const auto at = model::places_of(a.model, *section, c.nodes, state.u, memory);
    return of(model::section_on(*section, c.type), c.type, at.reference, at.displacement, memory);
  }
  [[nodiscard]] solid::CellStress<Dim> stress_of(std::size_t cell) const {
    return at_cell(cell, [](const auto&... of) { return solid::stress_at_points(of...); });
  }

  /// xx, yy, zz, xy, xz, yz.
  [[nodiscard]] static std::array<double, 6> tensor(const Vec<solid::components<Dim>>& s) {
    if constexpr (Dim == 2)
      return {s[0], s[1], s[2], s[3], 0, 0};
    else
      return {s[0], s[1], s[2], s[3], s[5], s[4]};
  }

  void at_points(Answer what) {
    if (request.totals == Totals::only) return;
    title(what == Answer::s      ? "stresses (elem, integ.pnt.,sxx,syy,szz,sxy,sxz,syz)"
          : what == Answer::e    ? "strains (elem, integ.pnt.,exx,eyy,ezz,exy,exz,eyz)"
          : what == Answer::ener ? "internal energy density (elem, integ.pnt.,energy)"
                                 : "equivalent plastic strain (elem, integ.pnt.,pe)");
    for (const std::size_t cell : cells()) {
      const solid::CellStress<Dim> stress = stress_of(cell);
      int number = 0;
      for (const std::size_t p : solid::in_order(stress)) {
        ++number;
        if (what == Answer::peeq || what == Answer::ener) {
          const double value =
              what == Answer::ener ? work_at(cell, stress, p) : equivalent_plastic_strain(cell, p);
          io::append_dat_row(out, a.mesh.cells[cell].number, number, {&value, 1});
        } else {
          const auto& point = stress.point[p];
          io::append_dat_row(out, a.mesh.cells[cell].number, number,
                             tensor(what == Answer::s ? point.stress : point.strain));
        }
      }
    }
  }

  /// Per reference volume.
  [[nodiscard]] double work_at(std::size_t cell, const solid::CellStress<Dim>& stress,
                               std::size_t point) const {
    return at_cell(cell, [&](const auto& section, auto type, const auto& reference, const auto&,
                             const material::Memory& memory) {
      const solid::CellEnergy energy =
          solid::point_energies<Dim>(section, type, reference, stress, memory)[point];
      return energy.stored + energy.dissipated;
    });
  }

  [[nodiscard]] double equivalent_plastic_strain(std::size_t cell, std::size_t point) const {
    const auto [section, memory] = a.place_in(system.model(), cell);
    const auto names = material::memory_of(section->section.law);
    for (std::size_t i = 0; i < names.size(); ++i)
      if (names[i].name == "PEEQ") return state.memory[memory.first + point * memory.size + i];
    return 0;
  }

  [[nodiscard]] double of_cell(Answer what, std::size_t cell) const {
    double value = 0;
    if (what == Answer::evol) {
      const solid::CellStress<Dim> stress = stress_of(cell);
      for (int p = 0; p < stress.count; ++p)
        value += stress.point[static_cast<std::size_t>(p)].volume;
    } else {
      const solid::CellEnergy energy =
          at_cell(cell, [](const auto&... of) { return solid::cell_energy(of...); });
      value = energy.stored + energy.dissipated;  // work on the cell, as there
    }
    return a.sector * value;
  }

  void by_cell(Answer what) {
    const bool volume = what == Answer::evol;
    double sum = 0;
    if (request.totals != Totals::only)
      title(volume ? "volume (element, volume)" : "internal energy (element, energy)");
    for (const std::size_t cell : cells()) {
      const double value = of_cell(what, cell);
      sum += value;
      if (request.totals != Totals::only)
        io::append_dat_row(out, a.mesh.cells[cell].number, 0, {&value, 1});
    }
    if (request.totals == Totals::none) return;
    title(volume ? "total volume" : "total internal energy");
    io::append_dat_total(out, {&sum, 1});
  }

  void through_facets() {
    const auto cut = a.built.cuts.find(request.on.at(0).value);
    if (cut == a.built.cuts.end()) return;
    out += io::dat_resultant(fmt::format("surface set {}", name), time,
                             resultant_through(a, system.model(), state, cut->second));
  }

  // ---- contact --------------------------------------------------------------------------------

  void contact(Answer what) {
    const std::vector<NodeContact> nodes = node_contacts(system, a.model);
    if (what == Answer::cnum) {
      out += io::dat_title("total number of contact elements for", time);
      out += fmt::format("{:17}\n", std::ranges::count_if(nodes, &NodeContact::closed));
      return;
    }
    if (what == Answer::cels) return energies();
    if (request.totals == Totals::only) return;
    const bool stress = what == Answer::cstr;
    const std::string_view title =
        stress ? "contact stress (slave node,press,tang1,tang2) for all contact elements and"
               : "relative contact displacement (slave node,normal,tang1,tang2) for all contact "
                 "elements and";
    out += fmt::format("\n {} time{}\n\n", title, io::fortran_real(time, 14, 7));
    for (const NodeContact& c : nodes)
      if (c.closed)
        io::append_dat_row(out, a.node_number[static_cast<std::size_t>(c.node)], 0,
                           std::span(c.values).subspan(stress ? 3 : 0, 3));
  }

  void energies() {
    const auto [of_nodes, total] = contact_energies(system, a.model);
    if (request.totals != Totals::only) {
      out += fmt::format(
          "\n contact print energy (slave node,energy) forall contact elements and time{}\n\n",
          io::fortran_real(time, 14, 7));
      for (const auto& [node, energy] : of_nodes) {
        const double value = a.sector * energy;
        io::append_dat_row(out, a.node_number[static_cast<std::size_t>(node)], 0, {&value, 1});
      }
    }
    if (request.totals == Totals::none) return;
    out += io::dat_title("total contact spring energy for", time);
    const double value = a.sector * total;
    io::append_dat_total(out, {&value, 1});
  }

  void add(Answer what) {
    switch (what) {
      case Answer::u:
        return displacements();
      case Answer::rf:
        return forces();
      case Answer::s:
      case Answer::e:
      case Answer::peeq:
      case Answer::ener:
        return at_points(what);
      case Answer::evol:
      case Answer::energy:
        return by_cell(what);
      case Answer::sof:
        return through_facets();
      default:
        return contact(what);
    }
  }
};

}  // namespace

template <int Dim>
AnswerModel<Dim>::AnswerModel(const deck::BasicBuilt<Dim>& all)
    : model(all.model), built(all), thin(mesh::thin_elements(all.model.mesh)) {
  const model::BasicModel<Dim>& of = all.model;
  std::vector<io::FrdMesh::Cell> cells;
  std::map<std::pair<Index, Index>, Place> found;
  std::vector<std::string> materials;
  model::for_each_cell(of, [&](const auto& section, const mesh::CellRef& ref, const auto& memory) {
    const auto material = std::ranges::find(materials, section.material);
    cells.push_back({ref, static_cast<int>(material - materials.begin()) + 1});
    if (material == materials.end()) materials.push_back(section.material);
    found[{ref.block, ref.cell}] = {&section, memory};
    if (is_ring(section.section)) sector = sector_of_ring;
  });
  mesh = io::frd_mesh(of.mesh, std::move(cells));
  for (const io::FrdMesh::Cell& cell : mesh.cells) {
    place_of[{cell.ref.block, cell.ref.cell}] = places.size();
    places.push_back(found.at({cell.ref.block, cell.ref.cell}));
  }
  for (std::size_t n = 0; n < of.mesh.nodes.size(); ++n)
    node_number.push_back(mesh::node_number(of.mesh, static_cast<Index>(n)));
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i)
    node_number[static_cast<std::size_t>(mesh.nodes[i])] = mesh.numbers[i];
}

template <int Dim>
io::FrdMesh AnswerModel<Dim>::as_given() const {
  std::map<std::pair<Index, Index>, const mesh::ThinElement*> as;
  for (const mesh::ThinElement& element : thin.elements)
    as[{element.cell.block, element.cell.cell}] = &element;
  std::vector<io::FrdMesh::Cell> cells = mesh.cells;
  for (io::FrdMesh::Cell& cell : cells)
    if (const auto found = as.find({cell.ref.block, cell.ref.cell}); found != as.end())
      cell.as = found->second;
  return io::frd_mesh(model.mesh, std::move(cells));
}

template <int Dim>
Vec3 AnswerModel<Dim>::displacement(const Eigen::VectorXd& u, Index node) const {
  Vec3 out = Vec3::Zero();
  if (const mesh::SectionMean* const mean = thin.mean_of(node); mean && !mean->leads)
    for (const auto& [n, share] : mean->shares)
      out.template head<Dim>() += share * u.segment<Dim>(Dim * n);
  else
    out.template head<Dim>() = u.segment<Dim>(Dim * node);
  return out;
}

template <int Dim>
typename AnswerModel<Dim>::Place AnswerModel<Dim>::place_in(const model::BasicModel<Dim>& running,
                                                            std::size_t cell) const {
  Place place = places[cell];
  const auto number = static_cast<std::size_t>(place.section - model.sections.data());
  place.section = &running.sections[number];
  place.memory.removed = model::is_removed(*place.section, place.memory.index);
  if (place.memory.initial) {
    const std::vector<double>& initial = place.section->initial[place.memory.index];
    place.memory.initial = initial.empty() ? nullptr : initial.data();
  }
  return place;
}

template <int Dim>
Vec3 AnswerModel<Dim>::force(const Eigen::VectorXd& nodal_forces, Index node) const {
  Vec3 force = Vec3::Zero();
  force.head<Dim>() = sector * nodal_forces.segment<Dim>(Dim * node);
  return force;
}

bool is_due(const deck::AnswerRequest& request, std::string_view step,
            const model::Progress& progress) {
  if (progress.increment == 0) return false;
  const auto named = [&](const deck::Name& name) { return name.value == step; };
  if (!request.steps.empty() && std::ranges::none_of(request.steps, named)) return false;
  return progress.increment % request.every == 0 || progress.fraction >= 1;
}

template <int Dim>
std::string answer_tables(const AnswerModel<Dim>& answers, const model::BasicSystem<Dim>& system,
                          const model::BasicState<Dim>& state, const deck::AnswerRequest& request,
                          double time) {
  Tables<Dim> tables{answers, system, state, request, time};
  for (const Answer what : request.of) tables.add(what);
  return std::move(tables.out);
}

template <int Dim>
std::vector<NodeContact> node_contacts(const model::BasicSystem<Dim>& system,
                                       const model::BasicModel<Dim>& model) {
  std::map<Index, NodeContact> by_node;
  for (std::size_t p = 0; p < model.pairs.size(); ++p) {
    const model::BasicContactFields<Dim> c = model::contact_fields(system, model, p);
    for (std::size_t i = 0; i < c.nodes.size(); ++i) {
      const auto shear = [](double on_slave) { return 0.0 - on_slave; };  // there on the master
      NodeContact now{c.nodes[i],
                      c.cstatus[i] > 0,
                      {c.copen[i], c.cslip[i], 0, c.cpress[i], shear(c.cshear[i]), 0}};
      if constexpr (Dim == 3) {
        now.values[2] = c.cslip2[i];
        now.values[5] = shear(c.cshear2[i]);
      }
      const auto [at, fresh] = by_node.try_emplace(c.nodes[i], now);
      if (!fresh && now.closed && now.values[3] >= at->second.values[3]) at->second = now;
    }
  }
  std::vector<NodeContact> list;
  for (const auto& [node, contact] : by_node) list.push_back(contact);
  return list;
}

template struct AnswerModel<2>;
template struct AnswerModel<3>;
template std::string answer_tables(const AnswerModel<2>&, const model::System&, const model::State&,
                                   const deck::AnswerRequest&, double);
template std::string answer_tables(const AnswerModel<3>&, const model::System3&,
                                   const model::State3&, const deck::AnswerRequest&, double);
template std::vector<NodeContact> node_contacts(const model::System&, const model::Model&);
template std::vector<NodeContact> node_contacts(const model::System3&, const model::Model3&);

}  // namespace osculate::result
