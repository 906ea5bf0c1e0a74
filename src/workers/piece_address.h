#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace split_mapf {

/// Which question of which client a message is about. Subjects:
/// - split_mapf.pieces.BUILD.CLIENT.BATCH.QUESTION  in the queue: a question
/// - split_mapf.answers.CLIENT.BATCH.QUESTION       its answer, or, without a byte, that it is
/// begun
/// - split_mapf.queued.CLIENT.BATCH.QUESTION        from the server: its place in the queue
/// - split_mapf.clients.CLIENT                      "alive"; "stop BATCH.QUESTION"; "stop BATCH.>"
/// BUILD tells sources, compiler and options: other builds may find other plans.
struct PieceAddress {
  std::string client;
  std::uint64_t batch = 0;
  std::uint64_t question = 0;

  std::string piece() const;
  std::string answer() const;
  std::string queued() const;
  /// BATCH.QUESTION.
  std::string name() const;
};

/// The address of a message of the queue, of an answer or of a place; nothing for other subjects.
std::optional<PieceAddress> addressOf(const std::string& subject);
/// Whether a message to a client says a place in the queue, and is no answer.
bool saysPlace(const std::string& subject);

/// Of all answers to a client, and all places; of what it says to workers; `*`: of all clients.
std::string messagesTo(const std::string& client);
std::string signsOf(const std::string& client);
/// All pieces that this build solves.
std::string piecesOfThisBuild();
/// The name under which workers of this build read the queue together.
std::string readersOfThisBuild();
/// Sources, compiler and options that plans may depend on, as a word.
std::string thisBuild();

}  // namespace split_mapf
