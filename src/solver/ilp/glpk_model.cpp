#include "solver/ilp/glpk_model.h"

#include <glpk.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <type_traits>

namespace split_mapf::ilp {
namespace {

// How often GLPK reports, and so how often the deadline is polled inside a simplex run.
constexpr int kPollMs = 20;
constexpr std::size_t kMostMegabytes = 1U << 20;

// One GLPK environment a thread, so one model a thread: giving up one frees the other's memory.
thread_local bool model_on_this_thread = false;

}  // namespace

/// What GLPK calls back.
struct GlpkModel::Hooks {
  /// Takes GLPK's words, and looks at the clock while it is about it.
  static int hear(void* info, const char* words) {
    auto* model = static_cast<GlpkModel*>(info);
    if (model->interrupted_) return 1;
    // The second thing that it says of an error is the place in its own sources.
    if (std::strncmp(words, "Error detected", 14) != 0) {
      std::strncpy(model->text_.data(), words, model->text_.size() - 1);
    }
    if (model->armed_ && model->deadline_.expired()) {
      model->interrupted_ = true;
      glp_error("interrupted\n");
    }
    return 1;
  }
  /// Called where GLPK would abort the process.
  static void leave(void* info) {
    auto* model = static_cast<GlpkModel*>(info);
    if (model->armed_) std::longjmp(model->jump_, 1);
  }
};

/// Runs a call into GLPK; false when it left by the jump. Nothing between the two may need a
/// destructor, as a jump runs none.
template <typename Call>
bool GlpkModel::returnsFrom(Call call) {
  static_assert(std::is_trivially_destructible_v<Call>);
  if (setjmp(jump_) != 0) {
    abandon();
    return false;
  }
  armed_ = true;
  call();
  armed_ = false;
  return true;
}

template <typename Call>
void GlpkModel::guard(Call call) {
  requireAlive();
  if (!returnsFrom(call)) fail();
}

GlpkModel::GlpkModel(const Deadline& deadline, std::size_t memory_mb)
    : deadline_(deadline), memory_mb_(std::clamp<std::size_t>(memory_mb, 1, kMostMegabytes)) {
  if (model_on_this_thread) throw std::logic_error("this thread has a GLPK model already");
  if (!returnsFrom([this] { install(); })) fail();
  model_on_this_thread = true;
}

GlpkModel::~GlpkModel() {
  if (problem_ == nullptr) return;
  // Gives the problem back too, and leaves nothing behind when the thread ends.
  glp_free_env();
  model_on_this_thread = false;
}

void GlpkModel::install() {
  glp_term_hook(Hooks::hear, this);
  glp_error_hook(Hooks::leave, this);
  glp_term_out(GLP_ON);  // the hook hears nothing otherwise
  glp_mem_limit(static_cast<int>(memory_mb_));
  problem_ = glp_create_prob();
  glp_set_obj_dir(problem_, GLP_MIN);
}

void GlpkModel::abandon() {
  armed_ = false;
  glp_free_env();
  problem_ = nullptr;
  model_on_this_thread = false;
}

void GlpkModel::requireAlive() const {
  if (problem_ == nullptr) {
    throw GlpkError(GlpkError::Kind::kFailure, "the GLPK model was given up before");
  }
}

void GlpkModel::fail() const {
  std::string said = text_.data();
  said.erase(std::find(said.begin(), said.end(), '\n'), said.end());
  const bool memory = said.find("memory") != std::string::npos;
  if (memory) {
    throw GlpkError(GlpkError::Kind::kMemory,
                    "GLPK needs more than " + std::to_string(memory_mb_) + " MiB");
  }
  throw GlpkError(GlpkError::Kind::kFailure, "GLPK gave up: " + said);
}

void GlpkModel::copyToOneBased(const std::vector<int>& index) {
  one_based_.assign(1, 0);
  for (const int i : index) one_based_.push_back(i + 1);
}

int GlpkModel::addRow(RowKind kind, double bound, const Coefficients& coefficients) {
  copyToOneBased(coefficients.index);
  one_based_value_.assign(1, 0);
  one_based_value_.insert(one_based_value_.end(), coefficients.value.begin(),
                          coefficients.value.end());
  guard([this, kind, bound] {
    const int type = kind == RowKind::kEqual ? GLP_FX : kind == RowKind::kAtMost ? GLP_UP : GLP_LO;
    const int row = glp_add_rows(problem_, 1);
    glp_set_row_bnds(problem_, row, type, bound, bound);
    glp_set_mat_row(problem_, row, static_cast<int>(one_based_.size()) - 1, one_based_.data(),
                    one_based_value_.data());
  });
  return rows_++;
}

int GlpkModel::addColumn(double cost, const Coefficients& coefficients) {
  copyToOneBased(coefficients.index);
  one_based_value_.assign(1, 0);
  one_based_value_.insert(one_based_value_.end(), coefficients.value.begin(),
                          coefficients.value.end());
  guard([this, cost] {
    const int column = glp_add_cols(problem_, 1);
    glp_set_col_bnds(problem_, column, GLP_LO, 0, 0);
    glp_set_obj_coef(problem_, column, cost);
    glp_set_mat_col(problem_, column, static_cast<int>(one_based_.size()) - 1, one_based_.data(),
                    one_based_value_.data());
  });
  return columns_++;
}

void GlpkModel::setBounds(int column, double lower, double upper) {
  guard([this, column, lower, upper] {
    const int type = std::isinf(upper) ? GLP_LO : lower == upper ? GLP_FX : GLP_DB;
    glp_set_col_bnds(problem_, column + 1, type, lower, upper);
  });
}

void GlpkModel::deleteRows(const std::vector<int>& rows) {
  if (rows.empty()) return;
  copyToOneBased(rows);
  guard([this] {
    glp_del_rows(problem_, static_cast<int>(one_based_.size()) - 1, one_based_.data());
  });
  rows_ -= static_cast<int>(rows.size());
}

void GlpkModel::deleteColumns(const std::vector<int>& columns) {
  if (columns.empty()) return;
  copyToOneBased(columns);
  guard([this] {
    glp_del_cols(problem_, static_cast<int>(one_based_.size()) - 1, one_based_.data());
  });
  columns_ -= static_cast<int>(columns.size());
}

LpStatus GlpkModel::solve(Simplex method) {
  requireAlive();
  if (deadline_.expired()) {
    interrupted_ = true;
    abandon();
    return LpStatus::kInterrupted;
  }
  const int before = glp_get_it_cnt(problem_);
  int code = 0;
  int* const result = &code;
  const bool returned = returnsFrom([this, method, result] {
    glp_smcp parameters;
    glp_init_smcp(&parameters);
    parameters.msg_lev = GLP_MSG_ON;
    parameters.out_frq = kPollMs;
    parameters.meth = method == Simplex::kPrimal ? GLP_PRIMAL : GLP_DUALP;
    *result = glp_simplex(problem_, &parameters);
    if (*result == 0) return;
    // A basis that has become singular or invalid is no verdict on the problem: begin anew.
    glp_std_basis(problem_);
    parameters.meth = GLP_PRIMAL;
    *result = glp_simplex(problem_, &parameters);
  });
  if (!returned) {
    if (interrupted_) return LpStatus::kInterrupted;
    fail();
  }
  work_ += static_cast<std::uint64_t>(glp_get_it_cnt(problem_) - before) *
           static_cast<std::uint64_t>(rows_ + columns_);
  return conclude(code);
}

LpStatus GlpkModel::conclude(int code) {
  if (code != 0) {
    throw GlpkError(GlpkError::Kind::kFailure,
                    "GLPK's simplex method failed with code " + std::to_string(code));
  }
  const int status = glp_get_status(problem_);
  if (status == GLP_NOFEAS) return LpStatus::kInfeasible;
  if (status != GLP_OPT) {
    throw GlpkError(GlpkError::Kind::kFailure,
                    "GLPK's simplex method ended with status " + std::to_string(status));
  }
  readSolution();
  return LpStatus::kOptimal;
}

// Adding rows or columns invalidates GLPK's own copy.
void GlpkModel::readSolution() {
  objective_ = glp_get_obj_val(problem_);
  const auto rows = static_cast<std::size_t>(rows_);
  const auto columns = static_cast<std::size_t>(columns_);
  dual_.resize(rows);
  basic_row_.resize(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    dual_[i] = glp_get_row_dual(problem_, static_cast<int>(i) + 1);
    basic_row_[i] = glp_get_row_stat(problem_, static_cast<int>(i) + 1) == GLP_BS ? 1 : 0;
  }
  primal_.resize(columns);
  reduced_.resize(columns);
  basic_column_.resize(columns);
  for (std::size_t j = 0; j < columns; ++j) {
    primal_[j] = glp_get_col_prim(problem_, static_cast<int>(j) + 1);
    reduced_[j] = glp_get_col_dual(problem_, static_cast<int>(j) + 1);
    basic_column_[j] = glp_get_col_stat(problem_, static_cast<int>(j) + 1) == GLP_BS ? 1 : 0;
  }
}

std::size_t GlpkModel::memoryBytes() const {
  if (problem_ == nullptr) return 0;
  int blocks = 0;
  int most_blocks = 0;
  std::size_t bytes = 0;
  std::size_t most_bytes = 0;
  glp_mem_usage(&blocks, &most_blocks, &bytes, &most_bytes);
  return bytes;
}

}  // namespace split_mapf::ilp
