#include "pipeline/rolling/step_maker.h"

#include <algorithm>
#include <cstddef>

namespace split_mapf::rolling {

StepMaker::StepMaker(const MoveGraph& graph, std::uint64_t seed)
    : graph_(graph),
      engine_(seed),
      robot_at_(graph.size(), kNoRobot),
      robot_next_(graph.size(), kNoRobot),
      swap_rule_(graph, robot_at_) {}

bool StepMaker::make(const std::vector<StepWish>& wishes, const std::vector<std::uint32_t>& order,
                     const WindowTable& table, std::vector<Slot>& moves) {
  moves_.assign(wishes.size(), MoveGraph::kNoSlot);
  for (std::uint32_t i = 0; i < wishes.size(); ++i) robot_at_[wishes[i].at] = i;
  bool done = bind(wishes);
  // Who stands where somebody is bound to go has the least choice.
  for (std::size_t i = 0; done && i < wishes.size(); ++i) {
    const bool open = moves_[i] == MoveGraph::kNoSlot;
    if (open && robot_next_[wishes[i].at] != kNoRobot) {
      done = move(static_cast<std::uint32_t>(i), wishes, table);
    }
  }
  for (std::size_t k = 0; done && k < order.size(); ++k) {
    if (moves_[order[k]] == MoveGraph::kNoSlot) done = move(order[k], wishes, table);
  }
  for (std::size_t i = 0; i < wishes.size(); ++i) {
    robot_at_[wishes[i].at] = kNoRobot;
    robot_next_[wishes[i].at] = kNoRobot;
    if (moves_[i] < kSlots) robot_next_[graph_[wishes[i].at].next[moves_[i]]] = kNoRobot;
  }
  moves = moves_;
  return done;
}

bool StepMaker::bind(const std::vector<StepWish>& wishes) {
  bool fits = true;
  for (std::uint32_t i = 0; i < wishes.size(); ++i) {
    if (!wishes[i].bound) continue;
    moves_[i] = wishes[i].wanted;
    const Vertex to = endOf(wishes[i], wishes[i].wanted);
    const std::uint32_t there = robot_at_[to];
    fits = fits && robot_next_[to] == kNoRobot;
    if (there != kNoRobot && there != i && moves_[there] != MoveGraph::kNoSlot) {
      fits = fits && endOf(wishes[there], moves_[there]) != wishes[i].at;
    }
    robot_next_[to] = i;
  }
  return fits;
}

bool StepMaker::move(std::uint32_t robot, const std::vector<StepWish>& wishes,
                     const WindowTable& table) {
  frames_.clear();
  open(robot, wishes, table);
  for (;;) {
    const Step step = advance(wishes);
    if (step == Step::kAsks) {
      const Frame& frame = frames_.back();
      open(robot_at_[endOf(wishes[frame.robot], moves_[frame.robot])], wishes, table);
      continue;
    }
    if (step == Step::kSettled) {
      for (; !frames_.empty(); frames_.pop_back()) follow(frames_.back(), wishes);
      return true;
    }
    frames_.pop_back();  // then whoever asked it to move tries something else
    if (frames_.empty()) return false;
  }
}

void StepMaker::open(std::uint32_t robot, const std::vector<StepWish>& wishes,
                     const WindowTable& table) {
  const StepWish& wish = wishes[robot];
  Frame frame{};
  frame.robot = robot;
  frame.partner = kNoRobot;
  sortChoices(frame, wish, table);
  // Who has plans of its own, or would rather stay, backs off for nobody.
  if (wish.wanted == MoveGraph::kNoSlot && !wish.isIdle()) {
    frame.partner = swap_rule_.partnerOf(robot, frame.choices[0], wishes, moves_, table);
    if (frame.partner != kNoRobot) {
      std::reverse(frame.choices.begin(), frame.choices.begin() + frame.count);
    }
  }
  frames_.push_back(frame);
}

void StepMaker::sortChoices(Frame& frame, const StepWish& wish, const WindowTable& table) {
  std::uint64_t random = engine_();
  std::array<std::uint32_t, kSlots + 1> keys{};
  const std::uint32_t nearer = wish.isIdle() ? 0U : wish.slope[wish.at];
  const std::uint32_t open = table[wish.at].open | 1U << kWait;
  for (Slot slot = 0; slot <= kWait; ++slot) {
    if ((open >> slot & 1U) == 0) continue;
    std::uint32_t key = wish.isIdle() == (slot == kWait) ? 1 : 2;  // idle: stay; others: do not
    if (!wish.isIdle()) {
      if ((nearer >> slot & 1U) != 0 && slot != kWait)
        key = 1;
      else if (slot == kWait || (nearer >> slot & 16U) != 0)
        key = 2;
      else
        key = 3;
    }
    if (slot == wish.wanted) key = 0;
    // Of equally good places rather one where nobody stands, and then the one straight on.
    const bool taken = slot != kWait && robot_at_[endOf(wish, slot)] != kNoRobot;
    const bool turns = slot != kWait && slot != wish.straight;
    key = (key << 2U | (taken ? 2U : 0U) | (turns ? 1U : 0U)) << 8U | (random & 0xffU);
    random >>= 8U;
    std::uint32_t place = frame.count++;
    for (; place > 0 && keys[place - 1] > key; --place) {
      keys[place] = keys[place - 1];
      frame.choices[place] = frame.choices[place - 1];
    }
    keys[place] = key;
    frame.choices[place] = slot;
  }
}

StepMaker::Step StepMaker::advance(const std::vector<StepWish>& wishes) {
  Frame& frame = frames_.back();
  const StepWish& wish = wishes[frame.robot];
  while (frame.tried < frame.count) {
    const Slot slot = frame.choices[frame.tried++];
    const Vertex to = endOf(wish, slot);
    if (robot_next_[to] != kNoRobot) continue;
    const std::uint32_t there = robot_at_[to];
    const bool settled = there == kNoRobot || moves_[there] != MoveGraph::kNoSlot;
    if (there != kNoRobot && there != frame.robot && settled &&
        endOf(wishes[there], moves_[there]) == wish.at) {
      continue;
    }
    robot_next_[to] = frame.robot;
    moves_[frame.robot] = slot;
    if (slot == kWait || settled) return Step::kSettled;
    return Step::kAsks;
  }
  // It stays: who had asked for its place looks elsewhere. Nobody asked for that of the first one;
  // when somebody bound comes there, nothing is left to try.
  moves_[frame.robot] = kWait;
  robot_next_[wish.at] = frame.robot;
  return Step::kStuck;
}

/// The partner of a robot that has backed off comes after it.
void StepMaker::follow(const Frame& frame, const std::vector<StepWish>& wishes) {
  if (frame.partner == kNoRobot || frame.tried != 1) return;
  const Vertex left = wishes[frame.robot].at;
  if (moves_[frame.partner] != MoveGraph::kNoSlot || robot_next_[left] != kNoRobot) return;
  robot_next_[left] = frame.partner;
  moves_[frame.partner] = graph_.slotOf(wishes[frame.partner].at, left);
}

}  // namespace split_mapf::rolling
