#pragma once

#include <string>

#include "split_mapf/pipeline/piece_workers.h"

namespace split_mapf {

/// Questions and answers about pieces as bytes, see piece_bytes.h. The same on every machine.
std::string toBytes(const PieceQuestion& question);
std::string toBytes(const PieceAnswer& answer);

/// Read what toBytes() wrote; never trust it: memory stays in proportion to the bytes.
/// @throws InputError naming the byte and what was expected there; InstanceError where the piece is
/// not well-posed.
PieceQuestion questionFromBytes(const std::string& bytes);
PieceAnswer answerFromBytes(const std::string& bytes);

}  // namespace split_mapf
