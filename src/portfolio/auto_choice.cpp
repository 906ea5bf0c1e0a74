#include "portfolio/auto_choice.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <tuple>
#include <vector>

#include "portfolio/solver_choice.h"
#include "search/crowd.h"

namespace split_mapf {
namespace {

// Plans that cost more than so many times the best expected are no choice while others are: at
// once, but refinement would take long to make up for them.
constexpr double kComparable = 1.25;
// From so many meetings a robot on (InstanceFeatures::head_on), after 10 s of refinement, plans
// that began as loose ones cost 2.5 (room-64-64-8, 300 robots) to 3 % less (warehouse-10-20-10-2-1,
// 1000), or as much as others (maze-32-32-4, 100); in halls and on open ground they only take
// longer.
constexpr double kHeadOn = 0.9;
// And the first plan may cost so many times the best.
constexpr double kComparableLoose = 1.5;
// Methods that take at most this many times the least are as soon as it: the best plan decides.
// Waiting longer for a better first plan does not pay, as refinement makes a better one meanwhile.
constexpr double kAsSoon = 1.2;
// A loose plan may be later by so much, which nobody notices.
constexpr double kUnnoticedSec = 0.02;
// Plans that are expected to cost so little more than the best are as good: `conflict_optimizer`
// and `prioritized` place robots by the same code, and mostly in the same way.
constexpr double kAsGood = 1.005;
// A race in turns: whoever has taken so many times what is expected has run into a jam that the
// model does not see, and it may take hundreds of times that. In expansions none on our maps takes
// more than about 5 times that but one (ost003d, 1000 robots, scenario 5: 10 times), and none more
// than 4 times where robots often meet head-on, which is where jams are. 5000 robots in a warehouse
// take 2.5 times that; a jam of a crowd would take all the time that another solver needs.
constexpr double kTurn = 25;
constexpr double kTurnHeadOn = 8;
constexpr double kTurnCrowd = 6;
constexpr double kOftenHeadOn = 0.5;
// Of searches that place robots; the others have as many or more.
constexpr double kExpansionsASecond = 4e6;
constexpr double kLeastTurn = 5e5;

std::string inSeconds(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2g s", seconds);
  return text;
}

/// On two threads, whatever their number is, as the choice of a solver, and so the plan, must not
/// depend on it.
double wallSeconds(const MethodEstimate& method, const SolverTraits& traits) {
  return method.seconds / traits.two_thread_gain;
}

/// `seconds` are those of the wall.
struct Candidate : MethodEstimate {
  double processor_sec = 0;  // whatever the threads
  bool loose = false;        // its plans
};

std::uint64_t turnOf(const Candidate& choice, const InstanceFeatures& features) {
  const bool is_crowd =
      features.robots >= kCrowd && kCellsOfCrowd * features.robots >= features.cells;
  const double times = is_crowd                           ? kTurnCrowd
                       : features.head_on >= kOftenHeadOn ? kTurnHeadOn
                                                          : kTurn;
  const double expansions = times * kExpansionsASecond * choice.processor_sec;
  return static_cast<std::uint64_t>(std::max(kLeastTurn, expansions));
}

/// A large team where there is room. There the model expects of searches that resolve conflicts far
/// less than they take (1000x1000 cells, 4500 robots, `ecbs`: 2 s instead of 65), and of those that
/// place robots about what they take.
bool isWideTeam(const InstanceFeatures& features) {
  return features.robots >= kCrowd && kCellsOfCrowd * features.robots < features.cells &&
         features.head_on < kOftenHeadOn;
}

double secondsOf(const std::string& solver, const std::vector<Candidate>& methods) {
  for (const Candidate& method : methods) {
    if (method.solver == solver) return method.seconds;
  }
  return 0;
}

SolverTraits traitsOf(const std::string& solver, const SolverTable& solvers) {
  const auto found = solvers.find(solver);
  return found != solvers.end() ? found->second : SolverTraits();
}

/// Those that there are. A split that was asked for says nothing of the solver: the
/// whole instance stands for its pieces.
std::vector<Candidate> candidates(const AutoQuestion& question, const CostModel& model) {
  std::vector<Candidate> result;
  for (MethodEstimate& method : model.estimate(question.features, question.objective)) {
    const SolverTraits traits = traitsOf(method.solver, question.solvers);
    if (question.solvers.count(method.solver) == 0 || !plansFor(traits, question.objective))
      continue;
    const double processor_sec = method.seconds;
    method.seconds = wallSeconds(method, traits);
    result.push_back({std::move(method), processor_sec, traits.loose_plans});
  }
  return result;
}

/// Leaves those that place robots one after another, where others are not to be trusted with them.
void keepPlacing(const AutoQuestion& question, std::vector<Candidate>& methods) {
  if (!isWideTeam(question.features) && !question.one_by_one) return;
  const auto places = [&](const Candidate& method) {
    return keepsStepTable(question.solvers, method.solver);
  };
  if (std::none_of(methods.begin(), methods.end(), places)) return;
  methods.erase(std::remove_if(methods.begin(), methods.end(),
                               [&](const Candidate& method) { return !places(method); }),
                methods.end());
}

/// Whether the pieces of a split do better with loose plans was not measured.
bool startsLoose(const AutoQuestion& question) {
  return question.refines && !question.splits && ruleOf(question.objective).sums() &&
         question.features.head_on >= kHeadOn;
}

bool costsLess(const MethodEstimate& a, const MethodEstimate& b) { return a.excess < b.excess; }
bool isSooner(const MethodEstimate& a, const MethodEstimate& b) { return a.seconds < b.seconds; }

/// The loose plan where it is wanted; then what is soon, those as good as the best in the model's
/// order and the others by cost; then what is not, by time.
void sortBestFirst(std::vector<Candidate>& methods, bool loose) {
  const double soonest_sec = std::min_element(methods.begin(), methods.end(), isSooner)->seconds;
  const double soon_sec = kAsSoon * soonest_sec;
  double least = std::numeric_limits<double>::infinity();
  for (const MethodEstimate& method : methods) {
    if (method.seconds <= soon_sec) least = std::min(least, method.excess);
  }
  const double good = kAsGood * (1 + least) - 1;
  const auto rank = [=](const Candidate& method) {
    const bool wanted = loose && method.loose && method.seconds <= soon_sec + kUnnoticedSec;
    const bool soon = method.seconds <= soon_sec;
    return std::make_tuple(!wanted, !soon, soon ? std::max(good, method.excess) : method.seconds);
  };
  std::stable_sort(methods.begin(), methods.end(),
                   [&](const Candidate& a, const Candidate& b) { return rank(a) < rank(b); });
}

}  // namespace

AutoChoice chooseMethod(const AutoQuestion& question, const CostModel& model) {
  std::vector<Candidate> methods = candidates(question, model);
  if (methods.empty()) {
    return {question.solvers.begin()->first, "nothing is known of it", 0, 0};
  }
  const std::string last_resort = lastResort(question.solvers, question.objective);
  const double last_resort_sec = secondsOf(last_resort, methods);
  keepPlacing(question, methods);
  const bool loose = startsLoose(question);
  const double least = std::min_element(methods.begin(), methods.end(), costsLess)->excess;
  const double most = (loose ? kComparableLoose : kComparable) * (1 + least) - 1;
  methods.erase(std::remove_if(methods.begin(), methods.end(),
                               [most](const MethodEstimate& m) { return m.excess > most; }),
                methods.end());
  sortBestFirst(methods, loose);
  const Candidate& first = methods.front();
  const bool is_last = first.solver == last_resort;
  AutoChoice choice{first.solver, inSeconds(first.seconds) + " expected",
                    is_last ? 0 : last_resort_sec, is_last ? 0 : turnOf(first, question.features)};
  if (methods.size() > 1) {
    choice.reason += ", " + inSeconds(methods[1].seconds) + " by " + methods[1].solver;
  }
  return choice;
}

}  // namespace split_mapf
