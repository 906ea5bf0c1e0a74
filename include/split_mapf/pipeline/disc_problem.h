#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "split_mapf/core/deadline.h"
#include "split_mapf/core/error.h"
#include "split_mapf/core/instance.h"
#include "split_mapf/core/plan.h"
#include "split_mapf/roadmap/attachment.h"
#include "split_mapf/roadmap/courses.h"
#include "split_mapf/roadmap/map_frame.h"
#include "split_mapf/roadmap/obstacle_raster.h"
#include "split_mapf/roadmap/roadmap.h"

namespace split_mapf {

/// Robots that have size, on a map: what the command and the node are asked.
struct DiscTask {
  std::shared_ptr<const ObstacleRaster> raster;
  MapFrame frame;                  ///< in which users know places
  std::vector<std::string> names;  ///< of the robots, as messages say them: "robot 'r1'"
  std::vector<RobotPoses> robots;  ///< on the raster; a negative radius: that of `roadmap`
  RoadmapOptions roadmap;
  double snap_distance_m = 0;  ///< greatest length of a leg; 0: one spacing of the lattice
};

/// Whether robots have size, or their cells are to be others than the map's, where its resolution
/// is known (0: it is not).
bool asksForRoadmap(const RoadmapOptions& options, double resolution_m = 0);

/// Robots that cannot be brought onto the planning graph, all of them; what() explains the first.
class AttachmentError : public InputError {
 public:
  /// @pre faults is not empty.
  AttachmentError(std::vector<AttachmentFault> faults, std::vector<std::string> messages);

  const std::vector<AttachmentFault>& faults() const { return faults_; }
  /// One a fault.
  const std::vector<std::string>& messages() const { return messages_; }

 private:
  std::vector<AttachmentFault> faults_;
  std::vector<std::string> messages_;
};

/// What becomes of a plan on the graph: every robot's way from pose to pose, checked.
struct DiscCourses {
  std::vector<Course> courses;            ///< on the raster
  std::vector<double> least_clearance_m;  ///< see DiscCheck
};

/// The one door through which robots that have size are planned for: their map's planning graph,
/// the robots' places on it, and the problem that remains for the solvers. Immutable; thread-safe.
class DiscProblem {
 public:
  /// Builds the graph for the largest robot and attaches all of them.
  /// @throws OptionError as buildRoadmap(), for a radius of a robot that is not finite, and for a
  /// snap distance out of range; InputError without robots; AttachmentError; Interrupted. Cost: see
  /// buildRoadmap() and attachRobots().
  DiscProblem(DiscTask task, const Deadline& deadline);

  const DiscTask& task() const { return task_; }
  const Roadmap& roadmap() const { return roadmap_; }
  const Attachment& attachment() const { return attachment_; }
  /// On the graph: from departure to arrival vertices.
  const Instance& instance() const { return *instance_; }
  /// The longest edge or leg [m]: what a robot covers in one step at most.
  double longestStep() const { return longest_step_m_; }
  /// The robots as checkDiscs() takes them.
  const Discs& discs() const { return discs_; }

  /// The robots' ways by a plan for instance(). @throws std::logic_error when discs would meet:
  /// nothing of such a plan may be shown to anybody; Interrupted.
  DiscCourses coursesOf(const Plan& plan, const Deadline& deadline = Deadline()) const;

 private:
  DiscTask task_;
  Discs discs_;
  Roadmap roadmap_;
  Attachment attachment_;
  std::shared_ptr<const Instance> instance_;
  double longest_step_m_ = 0;
};

}  // namespace split_mapf
