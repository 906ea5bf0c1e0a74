#include "workers/piece_address.h"

#include <vector>

#include <boost/algorithm/string/classification.hpp>
#include <boost/algorithm/string/split.hpp>

#include "workers/source_hash.h"

namespace split_mapf {
namespace {

constexpr const char* kQueued = "queued";

/// "split_mapf.KIND.".
std::string rootOf(const char* kind) { return std::string("split_mapf.") + kind + "."; }

std::optional<std::uint64_t> numberOf(const std::string& word) {
  constexpr std::size_t kMostDigits = 18;
  if (word.empty() || word.size() > kMostDigits) return std::nullopt;
  if (word.find_first_not_of("0123456789") != std::string::npos) return std::nullopt;
  return std::stoull(word);
}

}  // namespace

std::string PieceAddress::name() const {
  return std::to_string(batch) + "." + std::to_string(question);
}

std::string PieceAddress::piece() const {
  return rootOf("pieces") + thisBuild() + "." + client + "." + name();
}

std::string PieceAddress::answer() const { return rootOf("answers") + client + "." + name(); }

std::string PieceAddress::queued() const { return rootOf(kQueued) + client + "." + name(); }

std::optional<PieceAddress> addressOf(const std::string& subject) {
  std::vector<std::string> words;
  boost::algorithm::split(words, subject, boost::algorithm::is_any_of("."));
  constexpr std::size_t kLeastWords = 5;
  if (words.size() < kLeastWords) return std::nullopt;
  const std::size_t n = words.size();
  const auto batch = numberOf(words[n - 2]);
  const auto question = numberOf(words[n - 1]);
  if (!batch || !question || words[n - 3].empty()) return std::nullopt;
  return PieceAddress{words[n - 3], *batch, *question};
}

bool saysPlace(const std::string& subject) { return subject.rfind(rootOf(kQueued), 0) == 0; }

std::string messagesTo(const std::string& client) { return rootOf("*") + client + ".>"; }

std::string signsOf(const std::string& client) { return rootOf("clients") + client; }

std::string piecesOfThisBuild() { return rootOf("pieces") + thisBuild() + ".>"; }

std::string readersOfThisBuild() { return "workers_" + thisBuild(); }

std::string thisBuild() { return sourceHash(); }

}  // namespace split_mapf
