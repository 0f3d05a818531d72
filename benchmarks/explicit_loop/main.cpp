// Element updates per second of the explicit loop, beside what the memory allows in the same run.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "osculate/deck/build.hpp"
#include "osculate/deck/parse.hpp"
#include "osculate/model/system.hpp"

namespace {

using namespace osculate;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Bytes per second of a = b + s c over arrays far larger than the caches, best of five.
double bandwidth(int threads) {
  constexpr std::ptrdiff_t n = 1 << 24;
  std::vector<double> a(n), b(n), c(n);
#pragma omp parallel for num_threads(threads)
  for (std::ptrdiff_t i = 0; i < n; ++i) {
    a[static_cast<std::size_t>(i)] = 0;
    b[static_cast<std::size_t>(i)] = 1;
    c[static_cast<std::size_t>(i)] = 2;
  }
  double best = 1e30;
  for (int k = 0; k < 5; ++k) {
    const auto start = std::chrono::steady_clock::now();
#pragma omp parallel for num_threads(threads)
    for (std::ptrdiff_t i = 0; i < n; ++i) {
      const auto at = static_cast<std::size_t>(i);
      a[at] = b[at] + 3.0 * c[at];
    }
    best = std::min(best, seconds_since(start));
  }
  return 3.0 * sizeof(double) * static_cast<double>(n) / best;
}

/// What the process has in memory now, in MiB.
double resident() {
  std::ifstream pages("/proc/self/statm");
  double all = 0, here = 0;
  pages >> all >> here;
  return here * 4096 / (1 << 20);
}

/// `formulation`: empty: that of the section by default.
template <int Dim>
std::string model_text(int n, bool finite, const std::string& formulation) {
  const std::string box =
      Dim == 2 ? fmt::format("x: [0, 1], y: [0, 1], elements: [{0}, {0}]", n)
               : fmt::format("x: [0, 1], y: [0, 1], z: [0, 1], elements: [{0}, {0}, {0}]", n);
  const char* const law = finite ? "neo_hooke" : "linear_elastic";
  const std::string element = std::string(Dim == 2 ? "plane_strain" : "solid") +
                              (formulation.empty() ? "" : ", formulation: " + formulation);
  return fmt::format(R"(osculate: 1
title: A free body
mesh: {{generate: {{body: {{box: {{{}}}}}}}}}
materials: {{m: {{{}: {{E: 100, nu: 0.3, density: 1}}}}}}
sections: [{{on: body, material: m, element: {}}}]
initial_velocity: [{{on: body, vx: 1}}, {{on: body.left, vx: 1.01}}]
steps: [{{name: fly, increments: 1, duration: 1, dynamics: {{scheme: central_differences}}}}]
)",
                     box, law, element);
}

/// What one element update must move at least: the nodes of the cell once, and of one node the
/// reference position, position, velocity, acceleration and mass in, and position, velocity,
/// acceleration and force out.
constexpr double least_bytes(int dim) {
  const double nodes = dim == 2 ? 4 : 8;
  return 4 * nodes + 8.0 * dim * 9;
}

template <int Dim>
void measure(int n, bool finite, const std::string& formulation, int threads, int steps) {
  const deck::Description description =
      deck::parse_model(model_text<Dim>(n, finite, formulation), "benchmark.yaml");
  const auto built = [&] {
    if constexpr (Dim == 2)
      return deck::build(description, deck::load_mesh(description));
    else
      return deck::build3(description, deck::load_mesh(description));
  }();
  const double resident_before = resident();
  const auto set_up = std::chrono::steady_clock::now();
  model::BasicSystem<Dim> system(built.model, threads);
  model::BasicState<Dim> state = system.initial_state();
  system.begin_step(built.model.steps.front(), state);
  state = system.begin_motion(state);
  // The first increment also measures the stable step; time steps of the second one count.
  const double cell = 1.0 / n, step = 0.5 * cell / 12;
  state = system.advance(state, 5 * step).state;
  const double set_up_seconds = seconds_since(set_up), taken = resident() - resident_before;
  double best = 1e30, cells_part = 0;
  int count = 0;
  for (int k = 0; k < 3; ++k) {
    const double bulk = system.seconds().bulk;
    const auto start = std::chrono::steady_clock::now();
    const auto done = system.advance(state, state.fraction + steps * step);
    const double seconds = seconds_since(start) / done.time_steps.count;
    if (seconds < best) {
      best = seconds;
      cells_part = (system.seconds().bulk - bulk) / done.time_steps.count / seconds;
    }
    count = done.time_steps.count;
    state = done.state;
  }
  const double cells = std::pow(n, Dim), updates = cells / best;
  const double limit = bandwidth(threads) / least_bytes(Dim);
  const std::string name =
      fmt::format("{}, {} strains{}{}", Dim == 2 ? "quad4" : "hex8", finite ? "finite" : "small",
                  formulation.empty() ? "" : ", ", formulation);
  fmt::print(
      "| {} | {:.0f} | {} | {} | {:.2f} | {:.0f} | {:.1f} | {:.3f} | {:.2f} | {:.2f} | {:.0f} |\n",
      name, cells, threads, count, updates / 1e6, 1e9 / updates, limit / 1e6, updates / limit,
      cells_part, set_up_seconds, taken);
  std::fflush(stdout);
}

}  // namespace

int main(int count, char** arguments) {
  const int most = count > 1 ? std::atoi(arguments[1]) : 2;
  const int steps = count > 2 ? std::atoi(arguments[2]) : 20;
  fmt::print(
      "| cells | number | threads | time steps | updates [1e6/s] | ns an update | memory bound "
      "[1e6/s] | ratio | share of the cells | set-up [s] | memory [MiB] |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (int threads = 1; threads <= most; ++threads)
    for (const bool finite : {false, true})
      for (const char* const formulation : {"", "full", "reduced"}) {
        measure<2>(300, finite, formulation, threads, steps);
        measure<3>(40, finite, formulation, threads, steps);
      }
  return 0;
}
