#include "pipeline/rolling/improver.h"

#include <algorithm>

namespace split_mapf::rolling {
namespace {

// What a try costs beside its states, in states.
constexpr std::uint64_t kLook = 16;
constexpr int kWalks = 6;

}  // namespace

Improver::Improver(const MoveGraph& graph, const std::vector<bool>& closed, std::uint32_t steps,
                   ThreadTeam& team, std::uint64_t seed)
    : graph_(graph),
      steps_(steps),
      team_(team),
      who_(std::size_t{graph.size()} * (kMostSteps + 1), 0) {
  for (std::uint32_t i = 0; i < team_.threads(); ++i) {
    workers_.push_back({{WindowTable(graph, closed), WindowSearch(graph, steps), 0}});
  }
  for (std::uint32_t i = 0; i < kBatch; ++i) {
    proposals_.push_back({Proposal(seed * kBatch + i + 1)});
  }
}

void Improver::close(const std::vector<bool>& closed) {
  for (Apart<Worker>& worker : workers_) worker.value.table.close(closed);
}

void Improver::begin(FleetWindow& window) {
  window_ = &window;
  changes_.clear();
  team_.forEach(team_.threads(), [&](std::uint32_t i, std::uint32_t) {
    WindowTable& table = workers_[i].value.table;
    table.clear();
    for (const Track& track : window.tracks) table.flip(track, 0, steps_);
    workers_[i].value.repeated = 0;
  });
  costs_.assign(window.robots(), 0);
  place_.assign(window.robots(), kNoRobot);
  touched_.assign(window.robots(), 0);
  delayed_.clear();
  batch_ = 0;
  for (std::uint32_t robot = 0; robot < window.robots(); ++robot) {
    note(robot);
    const Itinerary& own = itinerary(robot);
    if (own.free_from >= steps_) continue;
    std::uint32_t reached = 0;
    const std::uint32_t before = own.costOf(window.tracks[robot], own.free_from, reached);
    setCost(robot, own.costOf(window.tracks[robot], steps_, reached) - before);
  }
}

void Improver::note(std::uint32_t robot) {
  const Track& track = window_->tracks[robot];
  for (std::uint32_t t = 0; t <= steps_; ++t) {
    who_[std::size_t{t} * graph_.size() + track.at[t]] = robot;
  }
}

std::uint32_t Improver::whoIs(Vertex v, std::uint32_t t) const {
  const std::uint32_t robot = who_[std::size_t{t} * graph_.size() + v];
  return robot < window_->robots() && window_->tracks[robot].at[t] == v ? robot : kNoRobot;
}

void Improver::setCost(std::uint32_t robot, std::uint32_t cost) {
  costs_[robot] = cost;
  if (cost > 0 && place_[robot] == kNoRobot) {
    place_[robot] = static_cast<std::uint32_t>(delayed_.size());
    delayed_.push_back(robot);
  } else if (cost == 0 && place_[robot] != kNoRobot) {
    const std::uint32_t last = delayed_.back();
    delayed_[place_[robot]] = last;
    place_[last] = place_[robot];
    delayed_.pop_back();
    place_[robot] = kNoRobot;
  }
}

std::uint64_t Improver::improve(std::uint64_t expansions, const Deadline& deadline) {
  std::uint64_t done = 0;
  while (done < expansions && !delayed_.empty() && !deadline.expired()) {
    ++batch_;
    team_.forEach(kBatch, [&](std::uint32_t i, std::uint32_t member) {
      tryOne(workers_[member].value, proposals_[i].value);
    });
    for (Apart<Proposal>& proposal : proposals_) {
      done += proposal.value.expansions + kLook;
      if (proposal.value.taken) take(proposal.value);
    }
  }
  return done;
}

void Improver::tryOne(Worker& worker, Proposal& proposal) {
  repeatChanges(worker);
  const std::uint64_t before = worker.search.expansions();
  choose(proposal);
  proposal.taken = replan(worker, proposal);
  proposal.expansions = worker.search.expansions() - before;
}

void Improver::choose(Proposal& proposal) const {
  RandomEngine& engine = proposal.engine;
  const std::uint32_t first = delayed_[drawBelow(engine, delayed_.size())];
  // Small ones gain the most for their effort, large ones what no small one does.
  const std::uint64_t sizes = kMostMembers - 1;
  const auto size =
      static_cast<std::uint32_t>(2 + std::min(drawBelow(engine, sizes), drawBelow(engine, sizes)));
  proposal.robots.assign(1, first);
  const std::uint32_t free_from = itinerary(first).free_from;
  for (int i = 0; i < kWalks && proposal.robots.size() < size; ++i) {
    std::uint32_t from = free_from;
    std::uint32_t robot = first;
    if (i > 0) {
      // Later walks begin anywhere, of anybody who is in already.
      robot = proposal.robots[drawBelow(engine, proposal.robots.size())];
      const std::uint32_t least = itinerary(robot).free_from;
      from = least + static_cast<std::uint32_t>(drawBelow(engine, steps_ - least));
    }
    walk(robot, from, size, proposal);
  }
  shuffle(proposal.robots, engine);
}

void Improver::walk(std::uint32_t robot, std::uint32_t from, std::uint32_t size,
                    Proposal& proposal) const {
  const Track& track = window_->tracks[robot];
  const Itinerary& own = itinerary(robot);
  std::uint32_t reached = own.reachedAt(track.at[0], 0);
  for (std::uint32_t t = 1; t <= from; ++t) reached = own.reachedAt(track.at[t], reached);
  Vertex v = track.at[from];
  std::uint64_t random = proposal.engine();
  for (std::uint32_t t = from; t < steps_ && proposal.robots.size() < size; ++t) {
    if (own.isIdle(reached)) return;
    std::uint32_t nearer = own.slopes[reached][v] & 0xfU;
    if (nearer == 0) return;
    const std::uint32_t other = nearer & (nearer - 1);
    if (other != 0 && (random & 1U) != 0) nearer = other;
    random >>= 1U;
    const Vertex to = graph_[v].next[static_cast<std::size_t>(__builtin_ctz(nearer))];
    meet(robot, v, to, t, size, proposal);
    v = to;
    reached = own.reachedAt(v, reached);
  }
}

void Improver::meet(std::uint32_t robot, Vertex v, Vertex to, std::uint32_t t, std::uint32_t size,
                    Proposal& proposal) const {
  const auto add = [&](std::uint32_t other) {
    if (other == kNoRobot || other == robot || proposal.robots.size() >= size) return;
    if (itinerary(other).free_from >= steps_) return;
    const auto end = proposal.robots.end();
    if (std::find(proposal.robots.begin(), end, other) == end) proposal.robots.push_back(other);
  };
  add(whoIs(to, t + 1));
  const std::uint32_t oncoming = whoIs(to, t);
  if (oncoming != kNoRobot && window_->tracks[oncoming].at[t + 1] == v) add(oncoming);
}

bool Improver::replan(Worker& worker, Proposal& proposal) const {
  std::uint64_t left = 0;  // what the members may cost together
  for (const std::uint32_t robot : proposal.robots) {
    worker.table.flip(window_->tracks[robot], itinerary(robot).free_from, steps_);
    left += std::uint64_t{costs_[robot]} * itinerary(robot).weight;
  }
  proposal.members.clear();
  bool done = true;
  for (const std::uint32_t robot : proposal.robots) {
    const Itinerary& own = itinerary(robot);
    Member& member = proposal.members.emplace_back();
    member.robot = robot;
    member.track = window_->tracks[robot];
    const auto most = static_cast<std::uint32_t>(std::min<std::uint64_t>(left / own.weight, 1000));
    const auto cost = worker.search.find(worker.table, own, most, proposal.engine, member.track);
    if (!cost) {
      proposal.members.pop_back();
      done = false;
      break;
    }
    member.cost = *cost;
    left -= std::uint64_t{*cost} * own.weight;
    worker.table.flip(member.track, own.free_from, steps_);
  }
  for (const Member& member : proposal.members) {
    worker.table.flip(member.track, itinerary(member.robot).free_from, steps_);
  }
  for (const std::uint32_t robot : proposal.robots) {
    worker.table.flip(window_->tracks[robot], itinerary(robot).free_from, steps_);
  }
  return done;
}

bool Improver::take(Proposal& proposal) {
  for (const Member& member : proposal.members) {
    if (touched_[member.robot] == batch_) return false;
  }
  Worker& worker = workers_.front().value;
  repeatChanges(worker);
  WindowTable& table = worker.table;
  for (const Member& member : proposal.members) {
    table.flip(window_->tracks[member.robot], itinerary(member.robot).free_from, steps_);
  }
  const bool free =
      std::all_of(proposal.members.begin(), proposal.members.end(), [&](const Member& member) {
        return table.isFree(member.track, itinerary(member.robot).free_from, steps_);
      });
  for (const Member& member : proposal.members) {
    Track& track = window_->tracks[member.robot];
    const std::uint32_t from = itinerary(member.robot).free_from;
    table.flip(free ? member.track : track, from, steps_);
    if (!free) continue;
    changes_.push_back({member.robot, from, track, member.track});
    track = member.track;
    note(member.robot);
    setCost(member.robot, member.cost);
    touched_[member.robot] = batch_;
  }
  worker.repeated = changes_.size();
  return free;
}

void Improver::repeatChanges(Worker& worker) const {
  for (; worker.repeated < changes_.size(); ++worker.repeated) {
    const Change& change = changes_[worker.repeated];
    worker.table.flip(change.before, change.from, steps_);
    worker.table.flip(change.after, change.from, steps_);
  }
}

}  // namespace split_mapf::rolling
