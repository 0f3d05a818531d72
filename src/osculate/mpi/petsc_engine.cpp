#include "osculate/mpi/petsc_engine.hpp"

#include <petscksp.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace osculate::mpi {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

void check(PetscErrorCode code) {
  if (code == 0) return;
  if (code == PETSC_ERR_MEM) throw std::bad_alloc();
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw std::runtime_error(std::string("PETSc: ") + (text ? text : "unknown error"));
}

/// One of PETSc's objects.
template <class Object, PetscErrorCode (*destroy)(Object*)>
class Owned {
 public:
  Owned() = default;
  ~Owned() {  // together with the others, who know nothing of an error that is under way here
    if (std::uncaught_exceptions() == 0) reset();
  }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  void reset() {
    if (object_) destroy(&object_);
    object_ = nullptr;
  }
  [[nodiscard]] Object get() const { return object_; }
  Object* out() {
    reset();
    return &object_;
  }

 private:
  Object object_ = nullptr;
};
using OwnedMat = Owned<::Mat, MatDestroy>;
using OwnedVec = Owned<::Vec, VecDestroy>;
using OwnedKsp = Owned<KSP, KSPDestroy>;
using OwnedIs = Owned<IS, ISDestroy>;

/// Where unknowns stand among the rows of PETSc: those of a node in one block, one process after
/// the other.
struct Rows {
  int block = 1;
  Index first = 0, count = 0;      ///< rows of this process
  std::vector<Index> of_unknown;   ///< every one's
  std::vector<Index> owned;        ///< unknowns of this process
  std::vector<Index> idle;         ///< rows of this process that are no unknowns
  std::vector<int> sizes, starts;  ///< by process
};

/// One for every unknown.
std::vector<double> owners(const la::SparseMatrix& k) {
  std::vector<double> owner(at(k.n), -1);
  for (Index i = 0; i < k.n; ++i)
    if (k.row_start[at(i)] < k.row_start[at(i) + 1]) owner[at(i)] = k.ranks->rank();
  k.ranks->largest(owner);
  return owner;
}

Rows rows_of(const la::SparseMatrix& k, const la::Places& places) {
  const std::vector<double> owner = owners(k);
  Rows rows;
  rows.block = places.dimension;
  std::vector<Index> block_of(at(k.n)), block_of_node;
  std::vector<int> of_block;  // its process
  for (Index u = 0; u < k.n; ++u) {
    const Index node = places.node[at(u)];
    if (node >= 0 && at(node) >= block_of_node.size()) block_of_node.resize(at(node) + 1, -1);
    Index found = node >= 0 ? block_of_node[at(node)] : -1;
    if (found < 0) {
      found = static_cast<Index>(of_block.size());
      of_block.push_back(static_cast<int>(owner[at(u)]));
      if (node >= 0) block_of_node[at(node)] = found;
    }
    block_of[at(u)] = found;
  }
  const int me = k.ranks->rank(), processes = k.ranks->count();
  rows.sizes.assign(at(processes), 0);
  for (const int p : of_block) rows.sizes[at(p)] += rows.block;
  for (int p = 0, next = 0; p < processes; next += rows.sizes[at(p++)]) rows.starts.push_back(next);
  std::vector<int> next = rows.starts;
  std::vector<Index> begin;
  for (const int p : of_block) {
    begin.push_back(next[at(p)]);
    next[at(p)] += rows.block;
  }
  rows.first = rows.starts[at(me)];
  rows.count = rows.sizes[at(me)];
  std::vector<char> used(at(rows.count), 0);
  for (Index u = 0; u < k.n; ++u) {
    const int slot = places.node[at(u)] >= 0 ? places.direction[at(u)] : 0;
    rows.of_unknown.push_back(begin[at(block_of[at(u)])] + slot);
    if (static_cast<int>(owner[at(u)]) != me) continue;
    rows.owned.push_back(u);
    used[at(rows.of_unknown.back() - rows.first)] = 1;
  }
  for (Index r = 0; r < rows.count; ++r)
    if (used[at(r)] == 0) rows.idle.push_back(rows.first + r);
  return rows;
}

/// Of the places in the rows of this process (FNV-1a).
std::uint64_t mark_of(const la::SparseMatrix& k, la::Symmetry symmetry) {
  std::uint64_t mark = 14695981039346656037U;
  const auto add = [&](Index value) {
    mark = (mark ^ static_cast<std::uint32_t>(value)) * 1099511628211U;
  };
  add(static_cast<Index>(symmetry));
  for (const Index start : k.row_start) add(start);
  for (const Index column : k.column) add(column);
  return mark;
}

/// Calls visit(row, column, value) for the entries of this process, of a symmetric matrix those of
/// the upper triangle on both sides.
template <class Visit>
void for_each_entry(const la::SparseMatrix& k, la::Symmetry symmetry, const Visit& visit) {
  const bool both = symmetry != la::Symmetry::unsymmetric;
  for (Index i = 0; i < k.n; ++i)
    for (Index e = k.row_start[at(i)]; e < k.row_start[at(i) + 1]; ++e) {
      const Index j = k.column[at(e)];
      if (both && j < i) continue;
      visit(i, j, k.value[at(e)]);
      if (both && j > i) visit(j, i, k.value[at(e)]);
    }
}

class PetscEngine final : public la::Engine {
 public:
  explicit PetscEngine(const core::Ranks& ranks) : ranks_(ranks) { begin_petsc(); }

  bool build(const la::SparseMatrix& k, la::Symmetry symmetry, const la::Places& places) override;
  bool refresh(const la::SparseMatrix& k, la::Symmetry symmetry, const la::Places& places) override;
  bool build_again(const la::Places& places) override { return prepare(places); }
  la::Nearby solve(const la::PreconditionedLimits& limits, Eigen::VectorXd& rhs) override;
  [[nodiscard]] Eigen::VectorXd diagonal() const override;
  [[nodiscard]] la::SparseMatrix matrix() const override;
  void forget() override;

 private:
  static void begin_petsc();
  void make_matrix(const la::SparseMatrix& k, la::Symmetry symmetry);
  void set_values(const la::SparseMatrix& k, la::Symmetry symmetry);
  void set_near_null(const la::Places& places);
  void find_exact(const la::Places& places);
  bool factor_exact();
  bool prepare(const la::Places& places);
  [[nodiscard]] ::Vec vector();
  [[nodiscard]] Eigen::VectorXd of_all(const std::vector<double>& mine) const;
  [[nodiscard]] Eigen::VectorXd of_all(::Vec mine) const;
  static PetscErrorCode apply_exact(PC shell, ::Vec r, ::Vec x);

  const core::Ranks& ranks_;
  Rows rows_;
  std::uint64_t mark_ = 0;
  OwnedMat a_, of_exact_;
  OwnedKsp ksp_, exact_;
  OwnedIs exact_rows_;
  bool any_exact_ = false;
};

void PetscEngine::begin_petsc() {
  PetscBool begun = PETSC_FALSE;
  check(PetscInitialized(&begun));
  if (begun) return;
  check(PetscInitializeNoArguments());
  PetscPopSignalHandler();
  check(PetscPushErrorHandler(PetscIgnoreErrorHandler, nullptr));
}

void PetscEngine::make_matrix(const la::SparseMatrix& k, la::Symmetry symmetry) {
  std::vector<PetscInt> i, j;
  for_each_entry(k, symmetry, [&](Index row, Index column, double) {
    i.push_back(rows_.of_unknown[at(row)]);
    j.push_back(rows_.of_unknown[at(column)]);
  });
  for (const Index r : rows_.idle) {
    i.push_back(r);
    j.push_back(r);
  }
  check(MatCreate(MPI_COMM_WORLD, a_.out()));
  check(MatSetSizes(a_.get(), rows_.count, rows_.count, PETSC_DETERMINE, PETSC_DETERMINE));
  check(MatSetBlockSize(a_.get(), rows_.block));
  check(MatSetType(a_.get(), MATAIJ));
  check(MatSetPreallocationCOO(a_.get(), static_cast<PetscCount>(i.size()), i.data(), j.data()));
}

void PetscEngine::set_values(const la::SparseMatrix& k, la::Symmetry symmetry) {
  std::vector<PetscScalar> v;
  for_each_entry(k, symmetry, [&](Index, Index, double value) { v.push_back(value); });
  v.resize(v.size() + rows_.idle.size(), 1.0);
  check(MatSetValuesCOO(a_.get(), v.data(), INSERT_VALUES));
}

::Vec PetscEngine::vector() {
  ::Vec v = nullptr;
  check(MatCreateVecs(a_.get(), &v, nullptr));
  return v;
}

/// Rigid motions of what has neighbours, orthonormal.
void PetscEngine::set_near_null(const la::Places& places) {
  constexpr double dependent = 1e-10;
  std::vector<double> joined(places.node.size(), 0);  // not 0: it has
  for (const Index u : rows_.owned) {
    PetscInt count = 0;
    const PetscInt* columns = nullptr;
    const PetscScalar* values = nullptr;
    const PetscInt row = rows_.of_unknown[at(u)];
    check(MatGetRow(a_.get(), row, &count, &columns, &values));
    for (PetscInt e = 0; e < count; ++e)
      if (columns[e] != row && values[e] != 0) joined[at(u)] = 1;
    check(MatRestoreRow(a_.get(), row, &count, &columns, &values));
  }
  ranks_.largest(joined);
  std::vector<char> alone;
  for (const double j : joined) alone.push_back(j == 0 ? 1 : 0);
  const Eigen::MatrixXd motions = la::rigid_motions(places, alone);
  std::vector<Eigen::VectorXd> basis;
  for (Eigen::Index m = 0; m < motions.cols(); ++m) {
    Eigen::VectorXd v = motions.col(m);
    const double whole = v.norm();
    for (int twice = 0; twice < 2; ++twice)
      for (const Eigen::VectorXd& b : basis) v -= b.dot(v) * b;
    if (v.norm() > dependent * whole) basis.push_back(v.normalized());
  }
  std::vector<::Vec> vectors;
  for (const Eigen::VectorXd& b : basis) {
    vectors.push_back(vector());
    PetscScalar* here = nullptr;
    check(VecSet(vectors.back(), 0));
    check(VecGetArray(vectors.back(), &here));
    for (const Index u : rows_.owned) here[rows_.of_unknown[at(u)] - rows_.first] = b[u];
    check(VecRestoreArray(vectors.back(), &here));
  }
  MatNullSpace space = nullptr;
  check(MatNullSpaceCreate(MPI_COMM_WORLD, PETSC_FALSE, static_cast<PetscInt>(vectors.size()),
                           vectors.data(), &space));
  check(MatSetNearNullSpace(a_.get(), space));
  check(MatNullSpaceDestroy(&space));
  for (::Vec& v : vectors) check(VecDestroy(&v));
}

void PetscEngine::find_exact(const la::Places& places) {
  std::vector<PetscInt> exact;
  for (const Index u : rows_.owned)
    if (places.exact[at(u)] != 0 || places.node[at(u)] < 0)
      exact.push_back(rows_.of_unknown[at(u)]);
  std::sort(exact.begin(), exact.end());
  any_exact_ = ranks_.any(!exact.empty());
  check(ISCreateGeneral(MPI_COMM_WORLD, static_cast<PetscInt>(exact.size()), exact.data(),
                        PETSC_COPY_VALUES, exact_rows_.out()));
}

/// False: singular.
bool PetscEngine::factor_exact() {
  if (!any_exact_) return true;
  check(MatCreateSubMatrix(a_.get(), exact_rows_.get(), exact_rows_.get(), MAT_INITIAL_MATRIX,
                           of_exact_.out()));
  check(KSPCreate(MPI_COMM_WORLD, exact_.out()));
  check(KSPSetOperators(exact_.get(), of_exact_.get(), of_exact_.get()));
  check(KSPSetType(exact_.get(), KSPPREONLY));
  PC pc = nullptr;
  check(KSPGetPC(exact_.get(), &pc));
  check(PCSetType(pc, PCLU));
  check(PCFactorSetMatSolverType(pc, MATSOLVERMUMPS));
  check(KSPSetOptionsPrefix(exact_.get(), "osculate_exact_"));
  check(KSPSetFromOptions(exact_.get()));
  check(KSPSetUp(exact_.get()));
  PCFailedReason failed = PC_NOERROR;
  check(PCGetFailedReason(pc, &failed));
  return ranks_.all(failed == PC_NOERROR);
}

/// x = I_c K_cc^-1 I_c^T r
PetscErrorCode PetscEngine::apply_exact(PC shell, ::Vec r, ::Vec x) {
  void* context = nullptr;
  PetscCall(PCShellGetContext(shell, &context));
  auto& engine = *static_cast<PetscEngine*>(context);
  ::Vec from = nullptr, to = nullptr;
  PetscCall(VecSet(x, 0));
  PetscCall(VecGetSubVector(r, engine.exact_rows_.get(), &from));
  PetscCall(VecGetSubVector(x, engine.exact_rows_.get(), &to));
  PetscCall(KSPSolve(engine.exact_.get(), from, to));
  PetscCall(VecRestoreSubVector(x, engine.exact_rows_.get(), &to));
  PetscCall(VecRestoreSubVector(r, engine.exact_rows_.get(), &from));
  return 0;
}

/// False: it cannot be.
bool PetscEngine::prepare(const la::Places& places) {
  set_near_null(places);
  find_exact(places);
  if (!factor_exact()) return false;
  check(KSPCreate(MPI_COMM_WORLD, ksp_.out()));
  check(KSPSetOperators(ksp_.get(), a_.get(), a_.get()));
  check(KSPSetType(ksp_.get(), KSPGMRES));
  check(KSPSetPCSide(ksp_.get(), PC_RIGHT));
  PC pc = nullptr, bodies = nullptr;
  check(KSPGetPC(ksp_.get(), &pc));
  bodies = pc;
  if (any_exact_) {
    PC shell = nullptr;
    check(PCSetType(pc, PCCOMPOSITE));
    check(PCCompositeSetType(pc, PC_COMPOSITE_MULTIPLICATIVE));
    check(PCCompositeAddPCType(pc, PCSHELL));
    check(PCCompositeAddPCType(pc, PCGAMG));
    check(PCCompositeGetPC(pc, 0, &shell));
    check(PCCompositeGetPC(pc, 1, &bodies));
    check(PCShellSetContext(shell, this));
    check(PCShellSetApply(shell, apply_exact));
  } else {
    check(PCSetType(pc, PCGAMG));
  }
  check(PCSetOptionsPrefix(bodies, "osculate_bodies_"));
  constexpr PetscReal strength = 0.02;
  PetscReal strengths[] = {strength, strength, strength};
  check(PCGAMGSetThreshold(bodies, strengths, 3));
  check(PCGAMGSetReuseInterpolation(bodies, PETSC_TRUE));
  check(PCSetFromOptions(bodies));
  check(KSPSetUp(ksp_.get()));
  PCFailedReason failed = PC_NOERROR;
  check(PCGetFailedReason(bodies, &failed));
  return ranks_.all(failed == PC_NOERROR);
}

bool PetscEngine::build(const la::SparseMatrix& k, la::Symmetry symmetry,
                        const la::Places& places) {
  forget();
  if (!k.ranks) return false;
  rows_ = rows_of(k, places);
  mark_ = mark_of(k, symmetry);
  make_matrix(k, symmetry);
  set_values(k, symmetry);
  return prepare(places);
}

bool PetscEngine::refresh(const la::SparseMatrix& k, la::Symmetry symmetry,
                          const la::Places& places) {
  if (!ranks_.all(ksp_.get() != nullptr && mark_ == mark_of(k, symmetry))) return false;
  set_values(k, symmetry);
  find_exact(places);
  if (!factor_exact()) return false;
  check(KSPSetUp(ksp_.get()));
  return true;
}

Eigen::VectorXd PetscEngine::of_all(const std::vector<double>& mine) const {
  Eigen::VectorXd all(rows_.starts.back() + rows_.sizes.back());
  MPI_Allgatherv(mine.data(), rows_.count, MPI_DOUBLE, all.data(), rows_.sizes.data(),
                 rows_.starts.data(), MPI_DOUBLE, MPI_COMM_WORLD);
  return all(rows_.of_unknown);
}

Eigen::VectorXd PetscEngine::of_all(::Vec mine) const {
  const PetscScalar* here = nullptr;
  check(VecGetArrayRead(mine, &here));
  const std::vector<double> values(here, here + rows_.count);
  check(VecRestoreArrayRead(mine, &here));
  return of_all(values);
}

la::Nearby PetscEngine::solve(const la::PreconditionedLimits& limits, Eigen::VectorXd& rhs) {
  OwnedVec b, x, rest;
  *b.out() = vector();
  *x.out() = vector();
  *rest.out() = vector();
  PetscScalar* here = nullptr;
  check(VecSet(b.get(), 0));
  check(VecGetArray(b.get(), &here));
  for (const Index u : rows_.owned) here[rows_.of_unknown[at(u)] - rows_.first] = rhs[u];
  check(VecRestoreArray(b.get(), &here));
  constexpr PetscReal tiny = 1e-300, far = 1e10;
  check(KSPSetTolerances(ksp_.get(), limits.tolerance, tiny, far, limits.iterations));
  check(KSPGMRESSetRestart(ksp_.get(), limits.restart));
  check(KSPSolve(ksp_.get(), b.get(), x.get()));
  la::Nearby result;
  PetscInt iterations = 0;
  check(KSPGetIterationNumber(ksp_.get(), &iterations));
  result.iterations = static_cast<int>(iterations);
  PetscReal left = 0, size = 0;
  check(VecNorm(b.get(), NORM_2, &size));
  check(MatMult(a_.get(), x.get(), rest.get()));
  check(VecAXPY(rest.get(), -1, b.get()));
  check(VecNorm(rest.get(), NORM_2, &left));
  constexpr double rounding = 1 + 1e-6;
  result.solved = left <= rounding * std::max(limits.tolerance, limits.good_enough) * size;
  if (result.solved) rhs = of_all(x.get());
  return result;
}

Eigen::VectorXd PetscEngine::diagonal() const {
  OwnedVec v;
  check(MatCreateVecs(a_.get(), v.out(), nullptr));
  check(MatGetDiagonal(a_.get(), v.get()));
  return of_all(v.get()).cwiseAbs();
}

la::SparseMatrix PetscEngine::matrix() const {
  std::vector<Index> unknown_of(at(rows_.starts.back() + rows_.sizes.back()), -1);
  for (std::size_t u = 0; u < rows_.of_unknown.size(); ++u)
    unknown_of[at(rows_.of_unknown[u])] = static_cast<Index>(u);
  la::SparseMatrix k;
  k.n = static_cast<Index>(rows_.of_unknown.size());
  k.ranks = &ranks_;
  k.row_start = {0};
  std::size_t next = 0;
  std::vector<std::pair<Index, double>> row;
  for (Index u = 0; u < k.n; ++u) {
    row.clear();
    if (next < rows_.owned.size() && rows_.owned[next] == u) {
      ++next;
      PetscInt count = 0;
      const PetscInt* columns = nullptr;
      const PetscScalar* values = nullptr;
      const PetscInt of = rows_.of_unknown[at(u)];
      check(MatGetRow(a_.get(), of, &count, &columns, &values));
      for (PetscInt e = 0; e < count; ++e) row.emplace_back(unknown_of[at(columns[e])], values[e]);
      check(MatRestoreRow(a_.get(), of, &count, &columns, &values));
    }
    std::sort(row.begin(), row.end());
    for (const auto& [column, value] : row) {
      k.column.push_back(column);
      k.value.push_back(value);
    }
    k.row_start.push_back(static_cast<Index>(k.column.size()));
  }
  return k;
}

void PetscEngine::forget() {
  ksp_.reset();
  exact_.reset();
  of_exact_.reset();
  exact_rows_.reset();
  a_.reset();
}

}  // namespace

la::Engine* make_engine(const core::Ranks& ranks) { return new PetscEngine(ranks); }

void end_petsc() {
  PetscBool begun = PETSC_FALSE;
  if (PetscInitialized(&begun) == 0 && begun) PetscFinalize();
}

}  // namespace osculate::mpi
