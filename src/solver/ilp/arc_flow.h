#pragma once

#include <optional>

#include "solver/ilp/engine.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/objective.h"

namespace split_mapf::ilp {

/// Plans optimally with the arc-flow program of Yu and LaValle, T-RO 2016: a binary variable a
/// robot, move and step, flow conservation a robot, at most one robot a vertex and edge in each
/// step. For small teams, and as a reference for column generation. Deviations: robot i may take
/// d_i + delta steps only, with delta = 0, 1, 2, 4, ... until more cannot help; a robot that
/// arrives does so by a variable of its own, which stays; rows of vertices and edges come when they
/// are violated; depth-first branch and bound of our own over GLPK's simplex, which can be
/// interrupted.
/// @param known  a valid plan, if there is one; the result is about better ones.
/// @pre no robot is cut off.
EngineResult solveByArcFlow(const Instance& instance, Objective objective,
                            const std::optional<Plan>& known, const Effort& effort);

}  // namespace split_mapf::ilp
