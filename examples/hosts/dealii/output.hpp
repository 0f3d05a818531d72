#pragma once
// What blocks.cpp prints and writes: nothing of how it is solved.
#include <deal.II/base/point.h>
#include <deal.II/lac/vector.h>

#include <fstream>
#include <iostream>

#include "osculate/contact.hpp"

using namespace dealii;
using Numbers = Vector<double>;
constexpr unsigned dim = 3;

inline std::span<const double> as_span(const Numbers& v) { return {v.begin(), v.size()}; }
inline Numbers as_vector(std::span<const double> v) { return Numbers(v.begin(), v.end()); }

class Output {
 public:
  explicit Output(const Numbers& x) : reference(x) { std::cout << rows; }

  /// A row of increments.csv, by the names of columns of history.csv: what contact does to the
  /// upper block.
  void add(int iterations, const osculate::Result<3>& result) {
    Tensor<1, dim> force;
    for (unsigned dof = 0; dof < reference.size(); ++dof)
      if (reference[dof - dof % dim + 2] > 1.005) force[dof % dim] -= result.force()[dof];
    double normal = 0, work = 0;
    int slipping = 0;
    for (const osculate::ContactPoint<3>& p : result.points()) {
      normal -= p.weight * p.normal_traction;
      work += p.friction_work;
      slipping += p.status == osculate::Status::slip;
    }
    std::ostringstream row;
    row << std::setprecision(17) << iterations << ',' << force[0] << ',' << force[1] << ','
        << force[2] << ',' << normal << ',' << work << ',' << slipping << '\n';
    std::cout << row.str();
    rows += row.str();
  }

  /// The rows, and places, displacements and reactions of the nodes.
  void write(const std::string& folder, const Numbers& x, const Numbers& internal,
             const osculate::Result<3>& result) const {
    std::ofstream(folder + "/increments.csv") << rows;
    std::ofstream file(folder + "/nodes.csv");
    file << std::setprecision(17);
    for (unsigned n = 0; n < x.size(); n += dim) {
      for (unsigned i = n; i < n + dim; ++i) file << reference[i] << ',';
      for (unsigned i = n; i < n + dim; ++i) file << x[i] - reference[i] << ',';
      for (unsigned i = n; i < n + dim; ++i)
        file << internal[i] + result.force()[i] << (i == n + 2 ? '\n' : ',');
    }
  }

 private:
  Numbers reference;
  std::string rows = "iterations,force_x,force_y,force_z,normal_force,friction_work,slipping\n";
};
