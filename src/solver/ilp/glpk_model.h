#pragma once

#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "split_mapf/core/deadline.h"

// glpk.h is included by glpk_model.cpp alone.
struct glp_prob;

namespace split_mapf::ilp {

/// GLPK failed: out of memory, numerically stuck, or misused. The message says which.
class GlpkError : public std::runtime_error {
 public:
  enum class Kind { kMemory, kFailure };
  GlpkError(Kind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  Kind kind() const { return kind_; }

 private:
  Kind kind_;
};

/// How a solve ended.
enum class LpStatus {
  kOptimal,
  kInfeasible,   ///< proved
  kInterrupted,  ///< by the deadline; the model can only be destroyed afterwards
};

/// Which simplex method fits what was changed.
enum class Simplex {
  kPrimal,  ///< columns were added: the basis is still primal feasible
  kDual,    ///< rows were added or bounds changed
};

/// What a row demands of the sum of its terms.
enum class RowKind { kAtMost, kAtLeast, kEqual };

/// Coefficients of a row (by column) or of a column (by row). Indices begin at 0, none twice.
struct Coefficients {
  std::vector<int> index;
  std::vector<double> value;

  void add(int i, double v) {
    index.push_back(i);
    value.push_back(v);
  }
  void clear() {
    index.clear();
    value.clear();
  }
};

/// A linear minimisation problem, and the only door to GLPK.
///
/// GLPK keeps its state a thread, aborts the process on misuse, and has no callback in its simplex.
/// Hence: a model lives and dies on one thread, at most one a thread at a time; every call into
/// GLPK runs under an error hook that jumps back here and becomes a GlpkError; the deadline is
/// polled from GLPK's output hook, every 20 ms, and leaves by the same jump. Who leaves so gives
/// all that GLPK holds for this thread back at once; the model then refuses everything.
/// @throws GlpkError from every member that calls GLPK.
class GlpkModel {
 public:
  /// @param memory_mb  what GLPK may allocate [MiB], at least 1. @throws std::logic_error when the
  /// thread has a model already.
  GlpkModel(const Deadline& deadline, std::size_t memory_mb);
  ~GlpkModel();
  GlpkModel(const GlpkModel&) = delete;
  GlpkModel& operator=(const GlpkModel&) = delete;

  /// Returns the row's index.
  int addRow(RowKind kind, double bound, const Coefficients& coefficients);
  /// Adds a column with 0 <= x. Returns its index.
  int addColumn(double cost, const Coefficients& coefficients);
  /// Allows lower <= x <= upper. @pre 0 <= lower <= upper; an infinite upper bound is none.
  void setBounds(int column, double lower, double upper);
  /// Deletes, and moves the indices behind up. @pre ascending.
  void deleteRows(const std::vector<int>& rows);
  void deleteColumns(const std::vector<int>& columns);

  int rows() const { return rows_; }
  int columns() const { return columns_; }

  LpStatus solve(Simplex method);

  /// Of the last solve() that answered kOptimal. What was added since is at 0 and out of the basis;
  /// deleting anything makes all of it void.
  double objective() const { return objective_; }
  double primal(int column) const { return at(primal_, column); }
  double dual(int row) const { return at(dual_, row); }
  double reducedCost(int column) const { return at(reduced_, column); }
  bool isBasicRow(int row) const { return at(basic_row_, row) != 0; }
  bool isBasicColumn(int column) const { return at(basic_column_, column) != 0; }

  /// What all solves so far have cost: simplex iterations, each times the rows and columns that the
  /// program had then. The same on every machine.
  std::uint64_t work() const { return work_; }
  /// What GLPK holds for this thread [bytes].
  std::size_t memoryBytes() const;

 private:
  struct Hooks;

  template <typename Value>
  static Value at(const std::vector<Value>& values, int i) {
    return static_cast<std::size_t>(i) < values.size() ? values[static_cast<std::size_t>(i)] : 0;
  }
  template <typename Call>
  bool returnsFrom(Call call);
  template <typename Call>
  void guard(Call call);
  void install();
  void abandon();
  void requireAlive() const;
  [[noreturn]] void fail() const;
  void copyToOneBased(const std::vector<int>& index);
  LpStatus conclude(int code);
  void readSolution();

  Deadline deadline_;
  std::size_t memory_mb_;
  glp_prob* problem_ = nullptr;
  int rows_ = 0;
  int columns_ = 0;
  std::jmp_buf jump_;
  bool armed_ = false;               // jump_ may be used
  bool interrupted_ = false;         // the jump was for the deadline's sake
  std::array<char, 256> text_ = {};  // the last thing that GLPK said
  std::vector<int> one_based_;       // scratch: GLPK counts from 1 and skips the first entry
  std::vector<double> one_based_value_;

  std::uint64_t work_ = 0;
  double objective_ = 0;
  std::vector<double> primal_;
  std::vector<double> reduced_;
  std::vector<double> dual_;
  std::vector<char> basic_row_;
  std::vector<char> basic_column_;
};

}  // namespace split_mapf::ilp
