#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "../body_path.hpp"
#include "../cases.hpp"
#include "../run_space.hpp"

namespace osculate::verification {
namespace {

constexpr const char* source = "its own increments halved twice";
constexpr const char* exact = "closed solution";
constexpr const char* schemes[] = {"newmark", "{hht: {alpha: 0.1}}",
                                   "{generalized_alpha: {radius: 0.6}}"};

/// Displacements (rotations too) and velocities of everything at the end; empty if it stopped.
struct End {
  Eigen::VectorXd way, velocity;
};

/// A model by its scheme and its number of increments.
using Text = std::function<std::string(const std::string& scheme, int increments)>;

std::string table(double rate, double duration, int points) {
  std::string text = "[";
  for (int i = 0; i <= points; ++i) {
    const double fraction = static_cast<double>(i) / points;
    text += fmt::format("{}[{:.17g}, {:.17g}]", i ? ", " : "", fraction,
                        std::sin(rate * fraction * duration));
  }
  return text + "]";
}

End at_the_end(const std::string& text) {
  End end;
  const model::AnalysisResult result = run_text(text, [&](const Snapshot& now) {
    const Eigen::Index n = now.state.u.size();
    end.velocity = now.state.rates.velocity;
    end.way.setZero(n + 3 * static_cast<Eigen::Index>(now.state.rigid.size()));
    end.way.head(n) = now.state.u;
    for (std::size_t b = 0; b < now.state.rigid.size(); ++b)
      for (int i = 0; i < 3; ++i)
        end.way[n + 3 * static_cast<Eigen::Index>(b) + i] = now.state.rigid[b].component(i);
  });
  return result.outcome == solve::Outcome::converged ? end : End{};
}

End at_the_end_in_space(const std::string& text, const Workers& workers) {
  End end;
  const model::AnalysisResult3 result = run_text3(text, workers, [&](const Snapshot3& now) {
    const Eigen::Index n = now.state.u.size();
    end.velocity = now.state.rates.velocity;
    end.way.setZero(n + 3 + 9);
    end.way.head(n) = now.state.u;
    end.way.segment<3>(n) = now.state.rigid[0].translation;
    const Mat<3, 3> orientation = now.state.rigid[0].orientation();
    end.way.tail<9>() = Eigen::Map<const Eigen::Matrix<double, 9, 1>>(orientation.data());
  });
  return result.outcome == solve::Outcome::converged ? end : End{};
}

/// Orders of displacements and velocities from three runs, each with half the increments' length of
/// the one before. `first_order_known`: of schemes with alpha_f > 0, whose orders are
/// told only.
void add_orders(CaseResult& out, const std::string& what, const Text& text, int increments,
                const std::function<End(const std::string&)>& run, bool first_order_known = false) {
  for (const std::string scheme : schemes) {
    End ends[3];
    bool finished = true;
    for (int i = 0; i < 3; ++i) {
      ends[i] = run(text(scheme, increments << i));
      finished = finished && ends[i].way.size() > 0;
    }
    const std::string name = what + ", " + scheme + ": ";
    if (!finished) {
      expect(out, name + "finished", 0, 1, 0, source);
      continue;
    }
    const auto order = [&](const Eigen::VectorXd End::*of) {
      return std::log2((ends[0].*of - ends[1].*of).norm() / (ends[1].*of - ends[2].*of).norm());
    };
    const Relation limit =
        first_order_known && scheme != schemes[0] ? Relation::info : Relation::at_least;
    out.rows.push_back({name + "order of displacements", order(&End::way), 1.9, limit, 0, source});
    out.rows.push_back(
        {name + "order of velocities", order(&End::velocity), 1.9, limit, 0, source});
    const double size = ends[2].way.norm();
    inform(out, name + "difference of the last two runs / displacement",
           (ends[1].way - ends[2].way).norm() / size, 0, source);
  }
}

// ---- an elastic block with damping, or under large deformation ----------------------------------

std::string loaded_block(const std::string& material, const std::string& kinematics,
                         const std::string& more, double load, const std::string& scheme,
                         int increments, int finest) {
  constexpr double duration = 1;
  return fmt::format(R"(osculate: 1
title: A block that is shaken by a load
mesh: {{generate: {{block: {{box: {{x: [0, 2], y: [0, 1], elements: [2, 1]}}}}}}}}
materials: {{m: {{{}: {{E: 40, nu: 0.3, density: 1}}}}}}
sections: [{{on: block, material: m, element: plane_strain, kinematics: {}}}]
amplitudes: {{wave: {}}}
steps:
  - name: shake
    increments: {}
    duration: {}
    dynamics: {{scheme: {}{}}}
    prescribe: [{{on: block.left, ux: 0, uy: 0}}]
    traction: [{{on: block.right, ty: {}, amplitude: wave}}]
solver: {{tolerance: {{residual: 1e-11, energy: 0.9}}}}
)",
                     material, kinematics, table(5, duration, finest), increments, duration, scheme,
                     more, load);
}

// ---- a rigid sled on a plane --------------------------------------------------------------------

/// It slides in both steps, and swings on the springs of the contact; the first step, whose
/// increments are always the same, is there to make it slide.
std::string sled(const std::string& scheme, int increments) {
  return fmt::format(R"(osculate: 1
title: A rigid sled on a plane
mesh: {{generate: {{sled: {{box: {{x: [0, 2], y: [0, 1], elements: [2, 1]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 1, nu: 0, density: 1e-9}}}}}}
sections: [{{on: sled, material: m, element: plane_strain}}]
rigid:
  body: {{set: sled, reference: [1, 0.5], mass: 2, inertia: 0.8}}
  floor: {{line: {{point: [0, 0.06], normal: [0, 1]}}}}
contact: [{{name: c, master: floor, slave: sled.bottom, sampling: nodes,
  normal: {{penalty: 200}}, friction: {{coulomb: {{mu: 0.2, penalty: 2.0e4}}}}}}]
initial_velocity: [{{on: body, vx: 6, vy: 0.05}}]
steps:
  - {{name: begin, increments: 4, duration: 0.01, gravity: [0, -9.81], dynamics: {{scheme: {0}, impact: average}}}}
  - {{name: slide, increments: {1}, duration: 0.5, dynamics: {{scheme: {0}, impact: average}}}}
solver: {{tolerance: {{residual: 1e-11, energy: 0.9}}}}
)",
                     scheme, increments);
}

// ---- a base that moves --------------------------------------------------------------------------

/// Two cells on a base that swings by sin 3t, and one that turns by 0.4 sin 3t.
std::string on_a_base(bool turns, const std::string& scheme, int increments, int finest) {
  const std::string rigid = "rigid: {base: {set: block.bottom, reference: [0, 0]}}\n";
  const std::string prescribe =
      turns ? "[{on: base, ux: 0, uy: 0, rz: 0.4, amplitude: wave}]"
            : "[{on: block.bottom, ux: 0}, {on: block.bottom, uy: 1, amplitude: wave}]";
  return fmt::format(R"(osculate: 1
title: A block on a base that moves
mesh: {{generate: {{block: {{box: {{x: [0.2, 1.2], y: [0, 2], elements: [1, 2]}}}}}}}}
materials: {{m: {{neo_hooke: {{E: 40, nu: 0.3, density: 1}}}}}}
sections: [{{on: block, material: m, element: plane_strain, formulation: full, kinematics: {}}}]
{}amplitudes: {{wave: {}}}
steps:
  - name: shake
    increments: {}
    duration: 1
    dynamics: {{scheme: {}, damping: {{mass: 0.2, stiffness: 2.0e-3}}}}
    prescribe: {}
solver: {{tolerance: {{residual: 1e-11, energy: 0.9}}}}
)",
                     "finite", turns ? rigid : "", table(3, 1, finest), increments, scheme,
                     prescribe);
}

// ---- a rigid body in space ----------------------------------------------------------------------

/// It flies and turns under a moment; alone, or with an elastic plate that sits on it.
std::string turning_body(bool plate, const std::string& scheme, int increments, int finest) {
  const std::string body = plate ? "{set: plate.bottom, reference: [0, 0, -0.5]"
                                 : "{sphere: {center: [0, 0, 0], radius: 1}";
  // The plate would be at rest while the body moves: an impact.
  const std::string start =
      plate ? "" : "initial_velocity: [{on: body, vx: 0.4, wx: 2, wy: -1, wz: 3}]\n";
  return fmt::format(R"(osculate: 1
title: A body that turns in space
mesh: {{generate: {{plate: {{box: {{x: [-1, 1], y: [-0.5, 0.5], z: [0, 0.5], elements: [2, 1, 1]}}}}}}}}
materials: {{m: {{neo_hooke: {{E: 400, nu: 0.3, density: 0.6}}}}}}
sections: [{{on: plate, material: m, element: solid, formulation: full, kinematics: finite}}]
rigid: {{body: {}, mass: 2.5, inertia: [1.2, 2.5, 3, 0.4, 0.2, -0.3]}}}}
amplitudes: {{wave: {}}}
{}steps:
  - name: turn
    increments: {}
    duration: 1
    dynamics: {{scheme: {}, damping: {{mass: 0.2}}}}
    prescribe: {}
    forces: [{{on: body, mx: 8, my: 5, mz: -6, fy: 1, amplitude: wave}}]
solver: {{tolerance: {{residual: 1e-11, energy: 0.9}}}}
)",
                     body, table(4, 1, finest), start, increments, scheme,
                     plate ? "[]" : "[{on: plate, ux: 0, uy: 0, uz: 0}]");
}

// ---- against a closed solution ------------------------------------------------------------------

/// A cell of height 1 on a base that moves by sin 3t, masses 1 at the top and 1/2 between top and
/// base, spring 4: u'' + 4 u = 8.5 sin 3t.
void add_shaken_mass(CaseResult& out) {
  constexpr double t = 2;
  const double way = 2.55 * std::sin(2 * t) - 1.7 * std::sin(3 * t);
  const double velocity = 5.1 * (std::cos(2 * t) - std::cos(3 * t));
  for (const std::string scheme : schemes) {
    double errors[2][2];
    for (int i = 0; i < 2; ++i) {
      const int n = 100 << i;
      const End end = at_the_end(fmt::format(R"(osculate: 1
title: A mass on a base that moves
mesh: {{generate: {{block: {{box: {{x: [0, 1], y: [0, 1], elements: [1, 1]}}}}}}}}
materials: {{m: {{linear_elastic: {{E: 4, nu: 0, density: 3}}}}}}
sections: [{{on: block, material: m, element: plane_strain}}]
amplitudes: {{wave: {}}}
steps: [{{name: shake, increments: {}, duration: {}, dynamics: {{scheme: {}}},
  prescribe: [{{on: block, ux: 0}}, {{on: block.bottom, uy: 1, amplitude: wave}}]}}]
)",
                                             table(3, t, n), n, t, scheme));
      const bool finished = end.way.size() > 0;
      const Eigen::Index top = 7;  // uy of the last node, in any order of the nodes at the top
      errors[i][0] = finished ? std::abs(end.way[top] - way) : 1;
      errors[i][1] = finished ? std::abs(end.velocity[top] - velocity) : 1;
    }
    const std::string name = "shaken mass, " + scheme + ": ";
    out.rows.push_back({name + "order of the displacement", std::log2(errors[0][0] / errors[1][0]),
                        1.9, Relation::at_least, 0, exact});
    out.rows.push_back({name + "order of the velocity", std::log2(errors[0][1] / errors[1][1]), 1.9,
                        Relation::at_least, 0, exact});
    inform(out, name + "error of the displacement, 200 increments", errors[1][0], 0, exact);
  }
}

}  // namespace

CaseResult time_order(const CaseContext& context) {
  CaseResult out;
  const auto in_plane = [](const std::string& text) { return at_the_end(text); };
  const auto in_space = [&](const std::string& text) {
    return at_the_end_in_space(text, context.workers);
  };
  add_orders(
      out, "damped block",
      [](const std::string& scheme, int n) {
        return loaded_block("linear_elastic", "small", ", damping: {mass: 0.5, stiffness: 5.0e-3}",
                            0.5, scheme, n, 400);
      },
      100, in_plane);
  add_orders(
      out, "large deformation",
      [](const std::string& scheme, int n) {
        return loaded_block("neo_hooke", "finite", "", 5, scheme, n, 400);
      },
      100, in_plane);
  add_orders(out, "sliding sled", sled, 100, in_plane);
  add_shaken_mass(out);
  for (const bool turns : {false, true})
    add_orders(
        out, turns ? "base that turns" : "base that moves",
        [&](const std::string& scheme, int n) { return on_a_base(turns, scheme, n, 400); }, 100,
        in_plane);
  for (const bool plate : {false, true})
    add_orders(
        out, plate ? "turning body with a plate" : "turning body",
        [&](const std::string& scheme, int n) {
          return turning_body(plate, scheme, n, plate ? 800 : 400);
        },
        plate ? 200 : 100, in_space, plate);
  return out;
}

}  // namespace osculate::verification
