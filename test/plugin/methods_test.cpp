// Plug-ins that do everything wrong that one can do without ending the process.
#include "split_mapf/plugin/methods.h"

#include <dlfcn.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>

#include "plugin/misbehaving_plugin.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/validate.h"
#include "split_mapf/pipeline/planner.h"
#include "split_mapf/solver/lacam.h"
#include "support/ascii_grid.h"

namespace split_mapf {
namespace {

constexpr double kPatienceSec = 60;
constexpr const char* kGivenUp = "did not stop at its deadline and was given up";

class PluginMethods : public ::testing::Test {
 protected:
  PluginMethods() {
    methods_.solvers = builtinSolvers();
    addSolver(std::make_shared<test::MisbehavingSolver>(), "a/solver", methods_);
    addSplitter(std::make_shared<test::MisbehavingSplitter>(), "a/splitter", methods_);
    test::misbehaving_may_end = false;
  }
  ~PluginMethods() override { letEnd(); }

  /// Lets those that hang end.
  static void letEnd() {
    test::misbehaving_may_end = true;
    while (abandonedCalls() > 0) pause();
  }
  static void pause() { std::this_thread::sleep_for(std::chrono::milliseconds(1)); }

  PlanReport plan(const PlanRequest& request, const Deadline& deadline = Deadline(kPatienceSec)) {
    return Planner(methods_.solvers, executor_, methods_.splitters)
        .plan(instance_, request, deadline);
  }
  /// Cancelled as soon as the plug-in hangs.
  PlanReport planUntilHung(const PlanRequest& request) {
    const auto stop = std::make_shared<StopFlag>();
    test::misbehaving_has_begun = false;
    std::atomic<bool> is_over{false};
    std::thread canceller([&] {
      while (!test::misbehaving_has_begun && !is_over) pause();
      stop->request();
    });
    PlanReport report = plan(request, Deadline(kPatienceSec, stop));
    is_over = true;
    canceller.join();
    EXPECT_TRUE(test::misbehaving_has_begun) << report.message;
    return report;
  }
  /// With a limit of time that expires while the plug-in runs.
  PlanReport planPastLimit(const PlanRequest& request) {
    test::misbehaving_has_begun = false;
    for (double limit_sec = 0.02;; limit_sec *= 2) {
      PlanReport report = plan(request, Deadline(limit_sec));
      if (test::misbehaving_has_begun || limit_sec > kPatienceSec) return report;
    }
  }
  static PlanRequest bySolver(const std::string& how) {
    PlanRequest request;
    request.solver = "misbehaving";
    request.solver_options = {"how=" + how};
    return request;
  }
  static PlanRequest bySplitter(const std::string& how) {
    PlanRequest request;
    request.solver = "lacam";
    request.split = "misbehaving";
    request.split_options = {"how=" + how};
    return request;
  }
  /// Expects that no plan is found, for this reason.
  void expectNoPlan(const PlanRequest& request, const std::string& why) {
    const PlanReport report = plan(request);
    EXPECT_EQ(report.termination, Termination::kNoPlanFound) << report.message;
    EXPECT_FALSE(report.plan);
    EXPECT_FALSE(report.optimal);
    EXPECT_NE(report.message.find(why), std::string::npos) << report.message;
  }

  Methods methods_;
  Executor executor_{2};
  const Instance instance_ = test::instanceFromAscii({"a.b..", ".....", "c...."},  //
                                                     {"b.a..", ".....", "....c"});
};

TEST_F(PluginMethods, AreRegisteredBesideTheOthers) {
  EXPECT_NE(methods_.solvers.info("misbehaving").description.find("(plug-in a/solver)"),
            std::string::npos);
  const PlanReport report = plan(bySolver("none"));
  ASSERT_TRUE(report.plan) << report.message;
  EXPECT_TRUE(validate(instance_, *report.plan).empty());
  PlanRequest split = bySolver("none");
  split.split = "misbehaving";
  ASSERT_TRUE(plan(split).plan);
  split.table_bytes = 1;
  ASSERT_TRUE(plan(split).plan) << "tables that are given up are no tables to share";
}

TEST_F(PluginMethods, AreNeverAskedUnnamed) {
  const SolverTraits& traits = methods_.solvers.info("misbehaving").traits;
  EXPECT_EQ(traits.fallback_rank, 0U);
  EXPECT_TRUE(traits.complete) << "what it promises stays";
}

TEST_F(PluginMethods, ASolverThatDoesWrongHasFoundNoPlan) {
  expectNoPlan(bySolver("throw"), "solver 'misbehaving' of plug-in 'a/solver' threw: no oil");
  expectNoPlan(bySolver("throw_int"), "threw something that is no std::exception");
  expectNoPlan(bySolver("collide"), "returned a plan with ");
  expectNoPlan(bySolver("outside"), "returned a plan with ");
  expectNoPlan(bySolver("no_paths"), "the plan has 0 paths, but the instance has 3 robots");
  expectNoPlan(bySolver("no_plan"), "contradicts itself: solved without a plan");
  expectNoPlan(bySolver("unsolvable"), "says that there is no plan, but there is one");
  expectNoPlan(bySolver("timeout"), "says timeout, but its deadline has not expired");
}

TEST_F(PluginMethods, WrongProofsAreNotBelieved) {
  const PlanReport report = plan(bySolver("bound"));
  ASSERT_TRUE(report.plan);
  EXPECT_EQ(report.proved_lower_bound, report.makespan_lower_bound);
  EXPECT_NE(report.certified_by, "ecbs");
}

TEST_F(PluginMethods, ASolverThatCannotBeMadeIsABadOption) {
  try {
    plan(bySolver("make"));
    FAIL() << "nothing was thrown";
  } catch (const OptionError& error) {
    EXPECT_STREQ(error.what(), "solver 'misbehaving' of plug-in 'a/solver' threw: no workshop");
  }
}

TEST_F(PluginMethods, AHangEndsAtItsLimitAndIsNotWaitedForAgain) {
  const PlanReport hung = planPastLimit(bySolver("hang"));
  EXPECT_EQ(hung.termination, Termination::kTimeout);
  EXPECT_NE(hung.message.find(kGivenUp), std::string::npos) << hung.message;
  EXPECT_EQ(abandonedCalls(), 1);

  // Its workers are free for others, and it is left alone until it has ended.
  PlanRequest other;
  other.solver = "lacam";
  EXPECT_TRUE(plan(other).plan);
  expectNoPlan(bySolver("none"), "a search of it that was given up still runs");
  letEnd();
  EXPECT_TRUE(plan(bySolver("none")).plan);
}

TEST_F(PluginMethods, AHangIsCancelled) {
  const PlanReport hung = planUntilHung(bySolver("hang"));
  EXPECT_EQ(hung.termination, Termination::kCancelled);
  EXPECT_NE(hung.message.find(kGivenUp), std::string::npos) << hung.message;
  EXPECT_EQ(abandonedCalls(), 1);
}

TEST_F(PluginMethods, OneThatIsLateIsWaitedForALittle) {
  // A machine that stands still for half a second may have it given up now and then.
  for (int attempt = 0; attempt < 10; ++attempt) {
    EXPECT_EQ(planUntilHung(bySolver("late")).termination, Termination::kCancelled);
    if (abandonedCalls() == 0) return;
    letEnd();
  }
  FAIL() << "it was given up each time";
}

TEST_F(PluginMethods, APluginOutlivesItsMethods) {
  auto plugin = std::make_shared<const test::MisbehavingSolver>();
  const std::weak_ptr<const test::MisbehavingSolver> still_there = plugin;
  {
    Methods methods;
    addSolver(std::move(plugin), "c/solver", methods);
  }
  EXPECT_FALSE(still_there.expired()) << "a search that was given up may use it";
}

TEST_F(PluginMethods, ASplitterThatDoesWrongHasFoundNoPlan) {
  ASSERT_TRUE(plan(bySplitter("none")).plan);
  expectNoPlan(bySplitter("throw"),
               "splitter 'misbehaving' of plug-in 'a/splitter' threw: no knife");
  expectNoPlan(bySplitter("no_pieces"), "made no pieces");
  expectNoPlan(bySplitter("null"), "a leaf of its tree has no piece");
  expectNoPlan(bySplitter("robots"), "piece 0 names a robot that there is not");
  expectNoPlan(bySplitter("twice"), "piece 0 names a robot twice");
  expectNoPlan(bySplitter("left_out"), "robot 1 is in no piece");
  expectNoPlan(bySplitter("other_map"), "piece 0 lies on another map");
  expectNoPlan(bySplitter("seam"), "splitter misbehaving made do not fit together");
}

TEST_F(PluginMethods, ASplitterWhoseMergeChangesNothingDoesNotGoOnForEver) {
  PlanRequest request = bySplitter("merge_nothing");
  request.solver = "misbehaving";
  request.solver_options = {"how=throw"};
  expectNoPlan(request, "says that it has replaced piece 0, which is among its pieces");
  request.split_options = {"how=reuse_id"};
  expectNoPlan(request, "piece 1 was another one before");
}

TEST_F(PluginMethods, ASplitterThatHangsIsGivenUp) {
  const PlanReport hung = planPastLimit(bySplitter("hang"));
  EXPECT_EQ(hung.termination, Termination::kTimeout);
  EXPECT_NE(hung.message.find(kGivenUp), std::string::npos) << hung.message;
  expectNoPlan(bySplitter("none"), "a call of it that was given up still runs");
  letEnd();
  test::misbehaving_may_end = false;
  EXPECT_EQ(planUntilHung(bySplitter("hang")).termination, Termination::kCancelled);
}

/// A plug-in with the info that a test says.
class Brings : public SolverPlugin {
 public:
  explicit Brings(SolverInfo info) : info_(std::move(info)) {}
  SolverInfo info() const override { return info_; }

 private:
  const SolverInfo info_;
};

TEST_F(PluginMethods, WhatCannotBeAddedIsRefusedWithItsName) {
  const auto fault_of = [this](SolverInfo info) -> std::string {
    try {
      addSolver(std::make_shared<Brings>(std::move(info)), "b/solver", methods_);
    } catch (const OptionError& error) {
      return error.what();
    }
    return "none";
  };
  SolverInfo info = LacamSolver::info();
  EXPECT_EQ(fault_of(info),
            "plug-in 'b/solver' cannot be added: solver 'lacam' is registered already");
  for (const char* name : {"auto", "", "two words", "\xff"}) {
    info.name = name;
    EXPECT_NE(fault_of(info).find("a name of a-z, 0-9 and _ is expected"), std::string::npos);
  }
  info.name = "useless";
  info.make = nullptr;
  EXPECT_EQ(fault_of(info), "plug-in 'b/solver' has no `make`");
}

TEST_F(PluginMethods, ALibraryThatIsNoneIsRefusedWithItsName) {
  const auto fault_of = [this](const std::string& file) -> std::string {
    try {
      loadPlugins(file, methods_);
    } catch (const OptionError& error) {
      return error.what();
    }
    return "none";
  };
  for (const char* file : {"no/such/library.so", "README.md"}) {
    EXPECT_EQ(fault_of(file).find("plug-in library '" + std::string(file) + "' cannot be loaded: "),
              0U)
        << fault_of(file);
  }
  Dl_info libc{};
  ASSERT_NE(::dladdr(::dlsym(RTLD_DEFAULT, "gnu_get_libc_version"), &libc), 0);
  const std::string file = libc.dli_fname;
  EXPECT_EQ(fault_of(file), "plug-in library '" + file +
                                "' exports no plug-ins: SPLIT_MAPF_EXPORT_PLUGINS(...) is expected "
                                "in it");
}

}  // namespace
}  // namespace split_mapf
