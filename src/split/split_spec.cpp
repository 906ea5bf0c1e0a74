#include "split_mapf/split/split_spec.h"

#include <cmath>
#include <cstdlib>

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

constexpr std::uint32_t kMostPieces = 4096;
constexpr double kRatioTolerance = 1e-6;

[[noreturn]] void fail(const std::string& text, const std::string& part, const std::string& why) {
  throw SplitSpecError("split " + quote(text) + ": " + quote(part) + " " + why +
                       "; expected none | auto | [space][time] with space = Ns | RxCs and time = "
                       "Kt | t(r1,...,rK), e.g. 4t, 2x2s, 4s8t, t(0.3,0.7)");
}

/// Reads a specification from left to right.
class Parser {
 public:
  explicit Parser(const std::string& text) : text_(text) {}

  SplitSpec parse() {
    SplitSpec spec;
    spec.kind = SplitSpec::Kind::kSplit;
    if (text_.empty()) fail(text_, text_, "is empty");
    if (atDigit()) parseNumbered(spec);
    if (position_ < text_.size()) parseTime(spec);
    if (position_ < text_.size()) fail(text_, rest(), "is left over");
    return spec;
  }

 private:
  bool atDigit() const {
    return position_ < text_.size() && text_[position_] >= '0' && text_[position_] <= '9';
  }
  bool accept(char c) {
    if (position_ >= text_.size() || text_[position_] != c) return false;
    ++position_;
    return true;
  }
  std::string rest() const { return text_.substr(position_); }

  std::uint32_t parseCount() {
    const std::size_t begin = position_;
    while (atDigit()) ++position_;
    const std::string digits = text_.substr(begin, position_ - begin);
    if (digits.empty()) fail(text_, rest(), "should begin with a number");
    if (digits.size() > 6 || std::stoul(digits) > kMostPieces || std::stoul(digits) == 0) {
      fail(text_, digits, "is out of range, 1 to " + std::to_string(kMostPieces) + " is possible");
    }
    return static_cast<std::uint32_t>(std::stoul(digits));
  }

  void parseNumbered(SplitSpec& spec) {
    const std::size_t begin = position_;
    const std::uint32_t first = parseCount();
    if (accept('t')) {
      spec.time_ratios.assign(first, 1.0 / first);
    } else if (accept('s')) {
      spec.space = mostSquare(first);
    } else if (accept('x')) {
      const std::uint32_t columns = parseCount();
      if (!accept('s')) fail(text_, text_.substr(begin), "should end its space part with s");
      spec.space = SplitSpec::Space{first, columns};
    } else {
      fail(text_, text_.substr(begin), "lacks its s or t");
    }
  }

  void parseTime(SplitSpec& spec) {
    if (!spec.time_ratios.empty()) fail(text_, rest(), "is left over");
    if (atDigit()) {
      const std::size_t begin = position_;
      const std::uint32_t pieces = parseCount();
      if (!accept('t')) fail(text_, text_.substr(begin), "lacks its t");
      spec.time_ratios.assign(pieces, 1.0 / pieces);
      return;
    }
    const std::string part = rest();
    if (!accept('t') || !accept('(')) fail(text_, part, "is no time part");
    do {
      if (spec.time_ratios.size() == kMostPieces) {
        fail(text_, part, "has more than " + std::to_string(kMostPieces) + " ratios");
      }
      spec.time_ratios.push_back(parseRatio());
    } while (accept(','));
    if (!accept(')')) fail(text_, part, "lacks its closing bracket");
    double sum = 0;
    for (const double ratio : spec.time_ratios) sum += ratio;
    if (std::abs(sum - 1) > kRatioTolerance) {
      fail(text_, part, "has ratios that sum to " + std::to_string(sum) + " instead of 1");
    }
  }

  double parseRatio() {
    const std::size_t end = text_.find_first_of(",)", position_);
    const std::string word = text_.substr(position_, end - position_);
    const bool plain =
        !word.empty() && word.find_first_not_of("0123456789.eE+-") == std::string::npos;
    char* stop = nullptr;
    const double value = plain ? std::strtod(word.c_str(), &stop) : 0;
    if (!plain || *stop != '\0' || !std::isfinite(value) || value <= 0) {
      fail(text_, word, "is no ratio greater than 0");
    }
    position_ += word.size();
    return value;
  }

  static SplitSpec::Space mostSquare(std::uint32_t regions) {
    auto rows = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(regions)));
    while (rows > 1 && regions % rows != 0) --rows;
    return {rows, regions / rows};
  }

  const std::string& text_;
  std::size_t position_ = 0;
};

}  // namespace

SplitSpec parseSplitSpec(const std::string& text) {
  if (text == "none" || text == "auto") return {};
  return Parser(text).parse();
}

}  // namespace split_mapf
