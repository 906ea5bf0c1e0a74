#pragma once

#include <cstddef>

#include <split_mapf/PlanLayout.h>
#include <visualization_msgs/MarkerArray.h>

#include "ros/scene/quad_mesh.h"

namespace split_mapf {

/// Adds who owns which cells in a phase of a space split: neighbours in a row that one region owns
/// are one piece. Points are from the layout's own origin. @pre phase < layout.phases.size().
/// @throws InputError, GoalError for a layout whose lists do not fit each other. Cost: O(cells).
void paintLayout(const PlanLayout& layout, std::size_t phase, QuadMesh& mesh);

/// The frame and the first point of a planning graph's markers, from which paintRoadmap() counts;
/// false when there is nothing to draw.
bool findRoadmap(const visualization_msgs::MarkerArray& markers, std::string& frame,
                 geometry_msgs::Point& origin);
/// Adds the edges and vertices of a planning graph, as the planner publishes them as markers.
/// Points and sizes that cannot be drawn are left out.
void paintRoadmap(const visualization_msgs::MarkerArray& markers,
                  const geometry_msgs::Point& origin, QuadMesh& mesh);

}  // namespace split_mapf
