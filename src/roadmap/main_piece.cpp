#include "roadmap/main_piece.h"

#include <algorithm>
#include <unordered_map>

namespace split_mapf::roadmap {

MainPiece::MainPiece(Draft& draft, Coverage& coverage, const Pieces& areas, std::uint32_t width,
                     const Deadline& deadline)
    : draft_(draft), coverage_(coverage), areas_(areas), width_(width), deadline_(deadline) {
  struct Largest {
    std::uint32_t first = 0;
    std::uint32_t size = 0;
  };
  std::unordered_map<std::uint32_t, Largest> largest;  // area -> its largest piece
  std::vector<std::uint8_t> seen(draft.size(), 0);
  std::vector<std::uint32_t> piece;
  for (std::uint32_t v = 0; v < draft.size(); ++v) {
    if (seen[v] != 0) continue;
    piece.assign(1, v);
    seen[v] = 1;
    for (std::size_t i = 0; i < piece.size(); ++i) {
      const Draft::Node& node = draft.node(piece[i]);
      for (std::uint32_t n = 0; n < node.degree; ++n) {
        if (seen[node.next[n]] != 0) continue;
        seen[node.next[n]] = 1;
        piece.push_back(node.next[n]);
      }
    }
    Largest& known = largest[areaOf(draft.at(v))];
    if (piece.size() > known.size) known = {v, static_cast<std::uint32_t>(piece.size())};
  }
  std::vector<std::uint32_t> firsts;
  firsts.reserve(largest.size());
  for (const auto& [area, known] : largest) firsts.push_back(known.first);
  std::sort(firsts.begin(), firsts.end());
  for (const std::uint32_t v : firsts) joinAround(v);
  draft_.commit();
  commit();
}

void MainPiece::join(std::uint32_t v) {
  deadline_.require();
  draft_.setMain(v, true);
  coverage_.add(draft_.at(v));
  log_.push_back({draft_.at(v), true});
  ++size_;
}

void MainPiece::leave(std::uint32_t v) {
  draft_.setMain(v, false);
  coverage_.remove(draft_.at(v));
  log_.push_back({draft_.at(v), false});
  --size_;
}

void MainPiece::joinAround(std::uint32_t v) {
  if (!draft_.node(v).main) join(v);
  std::vector<std::uint32_t> open = {v};
  while (!open.empty()) {
    const Draft::Node& node = draft_.node(open.back());
    open.pop_back();
    for (std::uint32_t i = 0; i < node.degree; ++i) {
      if (draft_.node(node.next[i]).main) continue;
      join(node.next[i]);
      open.push_back(node.next[i]);
    }
  }
}

void MainPiece::undoTo(std::size_t mark) {
  while (log_.size() > mark) {
    const Entry entry = log_.back();
    log_.pop_back();
    if (entry.joined) {
      coverage_.remove(entry.at);
      --size_;
    } else {
      coverage_.add(entry.at);
      ++size_;
    }
  }
}

void MainPiece::dropSevered(const std::vector<std::uint32_t>& ends) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> by_area;
  for (const std::uint32_t v : ends) {
    if (draft_.node(v).alive && draft_.node(v).main) by_area.emplace_back(areaOf(draft_.at(v)), v);
  }
  std::sort(by_area.begin(), by_area.end());
  by_area.erase(std::unique(by_area.begin(), by_area.end()), by_area.end());
  std::vector<std::uint32_t> group;
  for (std::size_t i = 0; i < by_area.size(); ++i) {
    group.push_back(by_area[i].second);
    if (i + 1 < by_area.size() && by_area[i + 1].first == by_area[i].first) continue;
    dropSeveredInArea(group);
    group.clear();
  }
}

/// Expands one vertex of a front; fronts that meet become one group.
void MainPiece::advance(std::vector<Front>& fronts, std::size_t i) {
  const Draft::Node& node = draft_.node(fronts[i].reached[fronts[i].next++]);
  for (std::uint32_t n = 0; n < node.degree; ++n) {
    const std::uint32_t u = node.next[n];
    if (stamps_[u] != stamp_) {
      stamps_[u] = stamp_;
      owners_[u] = static_cast<std::uint32_t>(i);
      fronts[i].reached.push_back(u);
      continue;
    }
    const std::uint32_t mine = fronts[i].group;
    const std::uint32_t met = fronts[owners_[u]].group;
    if (met == mine) continue;
    for (Front& front : fronts) {
      if (front.group == met) front.group = mine;
    }
  }
}

/// @return the groups that can still grow, at most one
std::vector<std::uint32_t> MainPiece::growUntilOneIsLeft(std::vector<Front>& fronts) {
  std::vector<std::uint32_t> growing;
  for (;;) {
    growing.clear();
    for (const Front& front : fronts) {
      if (!front.isSpent()) growing.push_back(front.group);
    }
    std::sort(growing.begin(), growing.end());
    growing.erase(std::unique(growing.begin(), growing.end()), growing.end());
    if (growing.size() <= 1) return growing;
    for (std::size_t i = 0; i < fronts.size(); ++i) {
      if (!fronts[i].isSpent()) advance(fronts, i);
    }
  }
}

std::uint32_t MainPiece::largestGroup(const std::vector<Front>& fronts) const {
  std::vector<std::size_t> sizes(fronts.size(), 0);
  for (const Front& front : fronts) {
    for (const std::uint32_t v : front.reached) sizes[front.group] += draft_.node(v).main ? 1 : 0;
  }
  return static_cast<std::uint32_t>(std::max_element(sizes.begin(), sizes.end()) - sizes.begin());
}

void MainPiece::dropSeveredInArea(const std::vector<std::uint32_t>& ends) {
  if (ends.size() < 2) return;
  stamps_.resize(draft_.size(), 0);
  owners_.resize(draft_.size(), 0);
  ++stamp_;
  std::vector<Front> fronts(ends.size());
  for (std::size_t i = 0; i < ends.size(); ++i) {
    fronts[i].group = static_cast<std::uint32_t>(i);
    fronts[i].reached.push_back(ends[i]);
    stamps_[ends[i]] = stamp_;
    owners_[ends[i]] = static_cast<std::uint32_t>(i);
  }
  const std::vector<std::uint32_t> growing = growUntilOneIsLeft(fronts);
  const std::uint32_t kept = growing.empty() ? largestGroup(fronts) : growing.front();
  for (const Front& front : fronts) {
    if (front.group == kept) continue;
    for (const std::uint32_t v : front.reached) {
      if (draft_.node(v).main) leave(v);
    }
  }
}

}  // namespace split_mapf::roadmap
