// The block of KS2D section 7.1, both choices of master and slave, small and finite strain.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "../cases.hpp"
#include "../run_model.hpp"

namespace osculate::verification {
namespace {

constexpr const char* paper = "KS2D 7.1";
constexpr const char* solver = "independent solver";
constexpr double mu = 0.3;
enum StepNumber { press, forward, turn, back, backward };

/// A contact point below the block. `ratio` is the friction on the block in +x over the pressure.
struct ContactPoint {
  double x = 0, ratio = 0;
  bool slip = false;
};

/// A converged increment.
struct Moment {
  Index step = 0;
  double top = 0, corner = 0;  ///< ux of the top (C) and of the bottom right corner (D)
  std::vector<double> ux;      ///< of the bottom nodes of the block, left to right
  std::vector<ContactPoint> points;
  double shear_force = 0, normal_force = 0;  ///< sums along the master's tangents and normals
  double normal = 0, shear = 0;   ///< contact forces on the block: pressure, friction in +x
  double base_x = 0, base_y = 0;  ///< force of the base's support
  double top_x = 0, top_y = 0;    ///< force of the support of the top
  int stick = 0, slip = 0;
};

struct Run {
  std::vector<double> x;  ///< of the bottom nodes of the block, left to right
  std::vector<Moment> moments;
  int increments = 0, iterations = 0, cutbacks = 0;
};

using Edit = std::function<void(deck::Built&)>;

std::vector<Index> left_to_right(const model::Model& model, const std::string& set) {
  std::vector<Index> nodes = model.mesh.find_set(set)->nodes;
  std::sort(nodes.begin(), nodes.end(), [&](Index a, Index b) {
    return model.reference[static_cast<std::size_t>(a)].x() <
           model.reference[static_cast<std::size_t>(b)].x();
  });
  return nodes;
}

std::vector<ContactPoint> contact_points(const Snapshot& now, const model::Model& model) {
  const pairing::PairDefinition<2>& pair = model.pairs[0].definition;
  const bool block_is_slave = model.body_of_node[static_cast<std::size_t>(pair.slave.nodes[0])] < 0;
  std::vector<ContactPoint> points;
  for (std::size_t k = 0; k < pair.slave.nodes.size(); ++k) {
    const pairing::PointResult<2>& p = now.system.contact()[0].points[k];
    if (p.status == contact::Status::open) continue;
    const double on_slave = -p.shear_traction[0] * p.frame.col(0).x();
    points.push_back({model.reference[static_cast<std::size_t>(pair.slave.nodes[k])].x(),
                      (block_is_slave ? on_slave : -on_slave) / -p.normal_traction,
                      p.status == contact::Status::slip});
  }
  std::sort(points.begin(), points.end(),
            [](const ContactPoint& a, const ContactPoint& b) { return a.x < b.x; });
  return points;
}

Moment moment_of(const Snapshot& now, const model::Model& model, const std::vector<Index>& bottom) {
  using Kind = model::HistoryRequest::Kind;
  const auto value = [&](Kind kind, const std::string& set, const char* quantity) {
    const model::HistoryRequest request{
        "", kind, 0, kind == Kind::nodes ? model.mesh.find_set(set)->nodes : std::vector<Index>{},
        quantity};
    return model::history_value(now.system, model, now.state, request);
  };
  Moment m;
  m.step = now.progress.step;
  m.top = value(Kind::nodes, "block.top", "ux");
  m.corner = value(Kind::nodes, "block.bottom_right", "ux");
  for (const Index n : bottom) m.ux.push_back(now.state.u[2 * n]);
  m.points = contact_points(now, model);
  const Index slave = model.pairs[0].definition.slave.nodes[0];
  const double side = model.body_of_node[static_cast<std::size_t>(slave)] < 0 ? 1 : -1;
  m.shear = side * value(Kind::pair, "", "force_x");
  m.normal = side * value(Kind::pair, "", "force_y");
  m.shear_force = value(Kind::pair, "", "shear_force");
  m.normal_force = value(Kind::pair, "", "normal_force");
  m.base_x = value(Kind::rigid, "", "rfx");
  m.base_y = value(Kind::rigid, "", "rfy");
  m.top_x = value(Kind::nodes, "block.top", "rfx");
  m.top_y = value(Kind::nodes, "block.top", "rfy");
  for (const ContactPoint& p : m.points) ++(p.slip ? m.slip : m.stick);
  return m;
}

Run run_block(const CaseContext& context, const std::string& model_file, const Edit& edit = {}) {
  Run run;
  const model::Model* model = nullptr;
  std::vector<Index> bottom;
  const auto look = [&](const Snapshot& now) {
    if (now.record) run.moments.push_back(moment_of(now, *model, bottom));
  };
  const model::AnalysisResult result =
      run_model(context.folder + "/" + model_file, look, [&](deck::Built& built) {
        context.workers.work_on(built.options);
        if (edit) edit(built);
        model = &built.model;
        bottom = left_to_right(built.model, "block.bottom");
        for (const Index n : bottom)
          run.x.push_back(built.model.reference[static_cast<std::size_t>(n)].x());
      });
  run.iterations = total_iterations(result);
  for (const model::StepRecord& step : result.steps)
    for (const solve::IncrementRecord& record : step.increments) {
      ++run.increments;
      run.cutbacks += record.cutbacks;
    }
  return run;
}

/// The increment that ends with the top at `u` on the way forward (or in the press step) or back.
const Moment& at(const Run& run, double u, bool on_the_way_back) {
  const auto found = std::find_if(run.moments.begin(), run.moments.end(), [&](const Moment& m) {
    return (m.step > forward) == on_the_way_back && std::abs(m.top - u) < 1e-9;
  });
  if (found == run.moments.end())
    throw std::runtime_error(fmt::format("no increment ends with the top at {}", u));
  return *found;
}

/// Left end of the unbroken run of slipping points that ends at the right end of the contact zone;
/// NaN when the last point sticks.
double slip_border(const Moment& m) {
  double border = std::nan("");
  for (auto p = m.points.rbegin(); p != m.points.rend() && p->slip; ++p) border = p->x;
  return border;
}

/// Forward increments in which the sliding zone is not an unbroken zone from the right end, or is
/// smaller than one increment before.
int growth_violations(const Run& run) {
  int violations = 0;
  double last = std::numeric_limits<double>::infinity();
  for (const Moment& m : run.moments) {
    if (m.step != forward) continue;
    const double border = slip_border(m);
    const auto in_zone =
        std::count_if(m.points.begin(), m.points.end(),
                      [&](const ContactPoint& p) { return p.slip && p.x >= border; });
    if (!(border <= last) || in_zone != m.slip) ++violations;
    last = border;
  }
  return violations;
}

int slips_while_returning(const Run& run) {
  int slips = 0;
  for (const Moment& m : run.moments)
    if (m.step == turn || m.step == back) slips += m.slip;
  return slips;
}

/// Top displacement at which all points slip backward for the first time; NaN if never.
double full_backward_sliding(const Run& run) {
  for (const Moment& m : run.moments)
    if (m.step == backward && m.stick == 0) return m.top;
  return std::nan("");
}

/// Largest deviation of |T| from mu N while all points slip, relative to mu N.
double coulomb_deviation(const Run& run) {
  double largest = 0;
  int seen = 0;
  for (const Moment& m : run.moments) {
    if (m.step != backward || m.stick > 0) continue;
    ++seen;
    largest = std::max(largest, std::abs(std::abs(m.shear_force) / (mu * m.normal_force) - 1));
  }
  return seen > 0 ? largest : std::nan("");
}

/// Largest sum of the forces on the block (supports of its top, contact) and on the base.
double unbalance(const Run& run) {
  double largest = 0;
  for (const Moment& m : run.moments)
    for (const double sum :
         {m.top_x + m.shear, m.top_y + m.normal, m.base_x - m.shear, m.base_y - m.normal})
      largest = std::max(largest, std::abs(sum) / m.normal);
  return largest;
}

void checked_rows(CaseResult& out, const std::string& name, const Run& run) {
  const auto row = [&](const std::string& quantity, double computed, double reference,
                       Relation relation, double tolerance, const char* source) {
    out.rows.push_back({name + ": " + quantity, computed, reference, relation, tolerance, source});
  };
  const Moment& left = at(run, -4e-3, true);
  row("increments", run.increments, 281, Relation::equal, 0, paper);
  row("cut-backs", run.cutbacks, 0, Relation::equal, 0, "");
  row("sliding not growing from the right", growth_violations(run), 0, Relation::equal, 0, paper);
  row("points slipping from turn to u = 0", slips_while_returning(run), 0, Relation::equal, 0,
      paper);
  row("left end slips at u = -0.004", left.points.front().slip ? 1 : 0, 1, Relation::equal, 0,
      paper);
  row("full sliding, ||T| / (mu N) - 1|", coulomb_deviation(run), 0, Relation::equal, 1e-9,
      "Coulomb");
  row("force balance / N", unbalance(run), 0, Relation::equal, 1e-9, "equilibrium");
}

void zone_rows(CaseResult& out, const std::string& name, const Run& run, double border, double full,
               const char* source) {
  out.rows.push_back({name + ": x of sliding zone at u = 0.008", slip_border(at(run, 8e-3, false)),
                      border, Relation::info, 0, source});
  out.rows.push_back({name + ": u of full backward sliding", full_backward_sliding(run), full,
                      Relation::info, 0, source});
}

/// What differs between two runs, relative to the largest value of the first, over the increments
/// with the same number of points in contact.
void difference_rows(CaseResult& out, const std::string& name, const Run& a, const Run& b) {
  double corner = 0, shear = 0, normal = 0, largest_corner = 0, largest_shear = 0,
         largest_normal = 0;
  int zones = 0, lost = 0;
  for (std::size_t k = 0; k < std::min(a.moments.size(), b.moments.size()); ++k) {
    const Moment &p = a.moments[k], &q = b.moments[k];
    largest_corner = std::max(largest_corner, std::abs(p.corner));
    largest_shear = std::max(largest_shear, std::abs(p.shear));
    largest_normal = std::max(largest_normal, p.normal);
    if (p.points.size() != q.points.size()) {
      ++lost;
      continue;
    }
    corner = std::max(corner, std::abs(p.corner - q.corner));
    shear = std::max(shear, std::abs(p.shear - q.shear));
    normal = std::max(normal, std::abs(p.normal - q.normal));
    zones += p.slip != q.slip ? 1 : 0;
  }
  const auto row = [&](const char* quantity, double value) {
    out.rows.push_back({name + ": " + quantity, value, 0, Relation::info, 0, "same model"});
  };
  row("difference of u at D", corner / largest_corner);
  row("difference of shear force", shear / largest_shear);
  row("difference of normal force", normal / largest_normal);
  row("increments with other slip points", zones);
  row("increments with a point beyond an end", lost);
}

Curve hysteresis(const Run& run) {
  Curve curve{"hysteresis", {"u_C", "u_D", "stick"}, {}};
  for (const Moment& m : run.moments)
    curve.rows.push_back({m.top, m.corner, static_cast<double>(m.stick)});
  return curve;
}

/// Profiles along the contact line at several positions of the top, one column each.
void add_profiles(CaseResult& out, const Run& run, const std::string& way,
                  const std::vector<std::pair<double, bool>>& tops) {
  Curve displacement{"displacement_" + way, {"x"}, {}}, ratio{"ratio_" + way, {"x"}, {}};
  for (const double x : run.x) displacement.rows.push_back({x});
  for (const ContactPoint& p : run.moments.front().points) ratio.rows.push_back({p.x});
  for (const auto& [top, on_the_way_back] : tops) {
    const Moment& m = at(run, top, on_the_way_back);
    displacement.columns.push_back(fmt::format("u={:.4g}", top));
    ratio.columns.push_back(fmt::format("u={:.4g}", top));
    for (std::size_t k = 0; k < m.ux.size(); ++k) displacement.rows[k].push_back(m.ux[k]);
    for (std::vector<double>& row : ratio.rows) {
      const auto p = std::find_if(m.points.begin(), m.points.end(),
                                  [&](const ContactPoint& q) { return q.x == row[0]; });
      row.push_back(p == m.points.end() ? std::nan("") : p->ratio);
    }
  }
  out.curves.push_back(std::move(displacement));
  out.curves.push_back(std::move(ratio));
}

/// Another vertical displacement of the top.
void press_by(deck::Built& built, double v) {
  for (model::PrescribedDof& p : built.model.steps[press].prescribed)
    if (p.ramp.target < 0) p.ramp.target = -v;
}

/// Moves the base, and with it its nodes, along itself.
void shift_base(deck::Built& built, double by) {
  model::Model& m = built.model;
  for (const Index n : m.rigid[0].nodes) {
    m.reference[static_cast<std::size_t>(n)].x() += by;
    m.mesh.nodes[static_cast<std::size_t>(n)].x() += by;
  }
}

}  // namespace

CaseResult sliding_block(const CaseContext& context) {
  CaseResult out;
  const Run slave = run_block(context, "block_slave_small.yaml");
  const Run slave_finite = run_block(context, "block_slave_finite.yaml");
  const Run master = run_block(context, "block_master_small.yaml");
  const Run master_finite = run_block(context, "block_master_finite.yaml");
  const auto iterations = [&](const char* name, const Run& run, double reference, Relation relation,
                              const char* source) {
    out.rows.push_back({fmt::format("{}: iterations", name), static_cast<double>(run.iterations),
                        reference, relation, 0, source});
  };
  iterations("block slave", slave, 514, Relation::at_most, solver);
  iterations("block slave (aim)", slave, 450, Relation::at_most, "");
  iterations("block slave, finite", slave_finite, 514, Relation::info, solver);
  iterations("block master", master, 691, Relation::info, solver);
  iterations("block master, finite", master_finite, 691, Relation::info, solver);
  checked_rows(out, "block slave", slave);
  checked_rows(out, "block slave, finite", slave_finite);
  checked_rows(out, "block master", master);
  checked_rows(out, "block master, finite", master_finite);

  zone_rows(out, "block slave", slave, 4, -6.9e-3, solver);
  zone_rows(out, "block master", master, 8, -9.2e-3, paper);
  zone_rows(out, "block master, finite", master_finite, 8, -9.2e-3, paper);
  const auto deeper = [](deck::Built& built) { press_by(built, 8.13e-3); };
  zone_rows(out, "block slave, v = 8.13e-3", run_block(context, "block_slave_small.yaml", deeper),
            7.5, -9.2e-3, solver);
  zone_rows(out, "block master, v = 8.13e-3", run_block(context, "block_master_small.yaml", deeper),
            8, -9.2e-3, paper);

  const Run slave_node = run_block(context, "block_slave_small.yaml", [](deck::Built& built) {
    built.model.pairs[0].definition.weight = pairing::Weight::node;
  });
  difference_rows(out, "roles exchanged", slave_node, master);
  difference_rows(out, "penalty per node", slave, slave_node);
  difference_rows(out, "finite strain", master, master_finite);
  const Run between = run_block(context, "block_master_small.yaml",
                                [](deck::Built& built) { shift_base(built, 0.25); });
  zone_rows(out, "slaves between nodes", between, 4, -6.9e-3, solver);
  out.rows.push_back({"slaves between nodes: points slipping from the turn to u = 0",
                      static_cast<double>(slips_while_returning(between)), 0, Relation::info, 0,
                      paper});

  out.curves.push_back(hysteresis(master));
  add_profiles(out, master, "forward", {{0, false}, {4e-3, false}, {6e-3, false}, {8e-3, false}});
  add_profiles(out, master, "backward",
               {{8e-3, false},
                {4e-3, true},
                {0, true},
                {-4e-3, true},
                {-6e-3, true},
                {-8e-3, true},
                {-10e-3, true}});
  return out;
}

}  // namespace osculate::verification
