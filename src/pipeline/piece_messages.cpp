#include "split_mapf/pipeline/piece_messages.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <utility>

#include "io/byte_stream.h"
#include "split_mapf/pipeline/piece_bytes.h"

namespace split_mapf {
namespace {

// Change with what follows them.
constexpr const char* kQuestionHead = "QUESTION1";
constexpr const char* kAnswerHead = "ANSWER1";
constexpr std::uint32_t kMostValues = 100;
constexpr std::uint32_t kAny = 0xffffffffU;

void writeReal(ByteWriter& out, double value) {
  std::uint64_t bits = 0;
  static_assert(sizeof bits == sizeof value, "a double has 64 bits");
  std::memcpy(&bits, &value, sizeof bits);
  out.number(bits);
}

double readReal(ByteReader& in, const std::string& name, double least) {
  const std::uint64_t bits = in.longNumber(name);
  double value = 0;
  std::memcpy(&value, &bits, sizeof value);
  if (!(value >= least)) in.fail(name + " is no number of at least " + std::to_string(least));
  return value;
}

void write(ByteWriter& out, const SolverOptions& options) {
  out.number(options.objective == Objective::kMakespan ? 0 : 1);
  writeReal(out, options.suboptimality);
  out.number(options.seed);
  out.number(options.expansion_limit);
  out.number(options.values.size());
  for (const auto& [name, value] : options.values) {
    out.sizedText(name);
    out.sizedText(value);
  }
}

SolverOptions readOptions(ByteReader& in) {
  SolverOptions options;
  options.objective =
      in.number("the objective", 1) == 0 ? Objective::kMakespan : Objective::kSumOfCosts;
  options.suboptimality = readReal(in, "the suboptimality", 1);
  options.seed = in.longNumber("the seed");
  options.expansion_limit = in.longNumber("the limit of expansions");
  for (std::uint32_t left = in.number("the number of options", kMostValues); left > 0; --left) {
    std::string name = in.sizedText("an option's name");
    options.values[std::move(name)] = in.sizedText("an option's value");
  }
  return options;
}

Termination readTermination(ByteReader& in) {
  const auto last = static_cast<std::uint32_t>(Termination::kMemoryLimit);
  return static_cast<Termination>(in.number("how the search ended", last));
}

}  // namespace

std::string toBytes(const PieceQuestion& question) {
  ByteWriter out;
  out.text(kQuestionHead);
  out.sizedText(question.solver);
  write(out, question.options);
  writeReal(out, question.limit_sec);
  out.text(toBytes(*question.piece));
  return out.take();
}

PieceQuestion questionFromBytes(const std::string& bytes) {
  ByteReader in(bytes, "question");
  in.expectText(kQuestionHead);
  PieceQuestion question;
  question.solver = in.sizedText("the solver");
  question.options = readOptions(in);
  question.limit_sec = readReal(in, "the limit of time", 0);
  question.piece = std::make_shared<const Piece>(pieceFromBytes(in.rest()));
  return question;
}

std::string toBytes(const PieceAnswer& answer) {
  const SolveResult& result = answer.result;
  ByteWriter out;
  out.text(kAnswerHead);
  out.number(static_cast<std::uint32_t>(result.termination));
  out.number(result.lower_bound);
  out.number(result.optimal ? 1 : 0);
  out.sizedText(result.certified_by);
  out.sizedText(result.message);
  out.number(result.high_level_nodes);
  out.number(result.low_level_expansions);
  out.number(answer.horizon);
  writeReal(out, answer.seconds);
  out.number(result.plan ? 1 : 0);
  if (result.plan) {
    out.number(result.plan->paths.size());
    for (const Path& path : result.plan->paths) out.numbers(path);
  }
  return out.take();
}

PieceAnswer answerFromBytes(const std::string& bytes) {
  ByteReader in(bytes, "answer");
  in.expectText(kAnswerHead);
  PieceAnswer answer;
  SolveResult& result = answer.result;
  result.termination = readTermination(in);
  result.lower_bound = in.longNumber("the lower bound");
  result.optimal = in.number("whether the plan is optimal", 1) == 1;
  result.certified_by = in.sizedText("who proved it");
  result.message = in.sizedText("the message");
  result.high_level_nodes = in.longNumber("the number of nodes");
  result.low_level_expansions = in.longNumber("the number of expansions");
  answer.horizon = in.number("the horizon");
  answer.seconds = readReal(in, "the seconds", 0);
  if (in.number("whether there is a plan", 1) == 1) {
    result.plan.emplace();
    result.plan->paths.resize(in.count("the number of paths"));
    for (Path& path : result.plan->paths) path = in.numbers("vertex", kAny - 1);
  }
  in.expectEnd();
  if (result.plan.has_value() != (result.termination == Termination::kSolved)) {
    in.fail("a plan is expected where the piece was solved, and only there");
  }
  return answer;
}

}  // namespace split_mapf
