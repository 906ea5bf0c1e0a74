#include "solver/lacam/pibt.h"

#include <algorithm>

namespace split_mapf {

Pibt::Pibt(const Instance& instance, const RobotDistances& distances, const Guidance* guidance,
           bool swap, std::uint64_t seed, const StepPrices* prices)
    : graph_(instance.graph()),
      distances_(distances),
      guidance_(guidance),
      prices_(prices),
      swap_(swap),
      engine_(seed),
      robot_at_(instance.graph().size(), kNoRobot),
      robot_next_(instance.graph().size(), kNoRobot),
      swap_rule_(instance, distances, robot_at_) {}

bool Pibt::complete(const Configuration& from, const std::vector<std::uint32_t>& order,
                    Configuration& next) {
  for (std::uint32_t i = 0; i < from.size(); ++i) robot_at_[from[i]] = i;
  bool done = reserveFixed(from, next);
  for (std::size_t k = 0; done && k < order.size(); ++k) {
    if (next[order[k]] == kNoVertex) done = move(order[k], from, next);
  }
  forget(from, next);
  return done;
}

bool Pibt::reserveFixed(const Configuration& from, const Configuration& next) {
  for (std::uint32_t i = 0; i < from.size(); ++i) {
    const Vertex to = next[i];
    if (to == kNoVertex) continue;
    if (robot_next_[to] != kNoRobot) return false;
    const std::uint32_t there = robot_at_[to];
    if (there != kNoRobot && there != i && next[there] == from[i]) return false;
    robot_next_[to] = i;
  }
  return true;
}

void Pibt::forget(const Configuration& from, const Configuration& next) {
  for (std::uint32_t i = 0; i < from.size(); ++i) {
    robot_at_[from[i]] = kNoRobot;
    robot_next_[from[i]] = kNoRobot;
    if (next[i] != kNoVertex) robot_next_[next[i]] = kNoRobot;
  }
}

bool Pibt::move(std::uint32_t robot, const Configuration& from, Configuration& next) {
  frames_.clear();
  open(robot, from, next);
  for (;;) {
    const Step step = advance(from, next);
    if (step == Step::kAsks) continue;
    if (step == Step::kStuck) {  // then whoever asked it to move tries something else
      frames_.pop_back();
      if (frames_.empty()) return false;
      continue;
    }
    for (; !frames_.empty(); frames_.pop_back()) follow(frames_.back(), from, next);
    return true;
  }
}

void Pibt::open(std::uint32_t robot, const Configuration& from, const Configuration& next) {
  ++expansions_;
  Frame frame;
  frame.robot = robot;
  frame.partner = kNoRobot;
  frame.tried = 0;
  sortChoices(frame, from[robot]);
  if (swap_) {
    frame.partner = swap_rule_.partnerOf(robot, frame.choices[0], from, next);
    if (frame.partner != kNoRobot) {
      std::reverse(frame.choices.begin(), frame.choices.begin() + frame.count);
    }
  }
  frames_.push_back(frame);
}

void Pibt::sortChoices(Frame& frame, Vertex at) {
  const Vertex guided = guidance_ != nullptr ? guidance_->next(frame.robot, at) : kNoVertex;
  std::uint64_t random = engine_();
  std::array<std::uint64_t, kMostChoices> keys;
  frame.count = 0;
  const auto insert = [&](Vertex v) {
    std::uint64_t key = 0;
    if (v != guided) {
      key = (keyOf(frame.robot, v) + 1) << 12 | (random & 0xfffU);
    }
    random >>= 12;
    std::uint32_t place = frame.count++;
    for (; place > 0 && keys[place - 1] > key; --place) {
      keys[place] = keys[place - 1];
      frame.choices[place] = frame.choices[place - 1];
    }
    keys[place] = key;
    frame.choices[place] = v;
  };
  for (const Vertex v : graph_.neighbours(at)) insert(v);
  insert(at);
}

std::uint64_t Pibt::keyOf(std::uint32_t robot, Vertex v) const {
  return prices_ == nullptr ? distances_(robot, v) : prices_->priceOf(robot, v, robot_at_[v]);
}

Pibt::Step Pibt::advance(const Configuration& from, Configuration& next) {
  Frame& frame = frames_.back();
  const Vertex at = from[frame.robot];
  while (frame.tried < frame.count) {
    const Vertex to = frame.choices[frame.tried++];
    if (robot_next_[to] != kNoRobot) continue;
    const std::uint32_t there = robot_at_[to];
    if (there != kNoRobot && next[there] == at) continue;
    robot_next_[to] = frame.robot;
    next[frame.robot] = to;
    if (there == kNoRobot || to == at || next[there] != kNoVertex) return Step::kSettled;
    open(there, from, next);
    return Step::kAsks;
  }
  robot_next_[at] = frame.robot;
  next[frame.robot] = at;
  return Step::kStuck;
}

void Pibt::follow(const Frame& frame, const Configuration& from, Configuration& next) {
  if (frame.partner == kNoRobot || frame.tried != 1) return;
  const Vertex left = from[frame.robot];
  if (next[frame.partner] != kNoVertex || robot_next_[left] != kNoRobot) return;
  robot_next_[left] = frame.partner;
  next[frame.partner] = left;
}

}  // namespace split_mapf
