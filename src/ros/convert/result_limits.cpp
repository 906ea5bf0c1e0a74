#include "ros/convert/result_limits.h"

#include <algorithm>
#include <limits>

#include "split_mapf/core/error.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

constexpr std::uint64_t kLengthField = 4;
constexpr std::uint64_t kHeader = 4 + 8 + kLengthField;  // sequence, stamp, frame_id
constexpr std::uint64_t kPose = std::uint64_t{7} * 8;
constexpr std::uint64_t kSize = 8 + 2 * kPose + 4 + 4 + 8;  // of a robot that has one, or not

std::uint64_t pointsOf(const PlanShape& shape) {
  std::uint64_t sum = 0;
  for (const std::uint32_t points : shape.points) sum += points;
  return sum;
}

/// "5000 robots with 12000000 cells"
std::string describe(const PlanShape& shape, bool least) {
  return counted(shape.ids.size(), "robot") + " on " + (least ? "at least " : "") +
         counted(pointsOf(shape), "cell");
}

}  // namespace

std::uint64_t serializedPaths(const PlanShape& shape, bool with_poses) {
  const std::uint64_t header = kHeader + shape.frame.size();
  const std::uint64_t a_point = kLengthField + (with_poses ? header + kPose : 0);
  // Without poses there is an empty path: a header without frame, and no poses.
  const std::uint64_t a_path = with_poses ? header : kHeader;
  std::uint64_t bytes = pointsOf(shape) * a_point;
  for (const std::string& id : shape.ids) {
    bytes += kLengthField + id.size() + kLengthField + a_path + kLengthField + kSize;
  }
  return bytes;
}

void requireSendable(const PlanShape& shape, bool fill_poses, bool publish_paths, bool least) {
  const std::uint64_t cells = serializedPaths(shape, false);
  const std::uint64_t poses = serializedPaths(shape, true) - cells;
  const std::string most = "; at most " + std::to_string(kMostPlanBytes) + " are possible";
  const std::string of = std::string(least ? " would have at least " : " would have ");
  if (cells > kMostPlanBytes) {
    throw OptionError("the result" + of + std::to_string(cells) + " bytes (" +
                      describe(shape, least) + ")" + most + ": plan for fewer robots at a time");
  }
  if (fill_poses && cells + poses > kMostPlanBytes) {
    throw OptionError("fill_poses: the result" + of + std::to_string(cells + poses) + " bytes (" +
                      describe(shape, least) + ")" + most + "; without fill_poses there are " +
                      std::to_string(cells));
  }
  if (publish_paths && poses > kMostPlanBytes) {
    throw OptionError("publish_paths: the published paths" + of + std::to_string(poses) +
                      " bytes together (" + describe(shape, least) + ")" + most +
                      "; the node's parameter publish_paths turns them off");
  }
}

void requireTimesFit(std::uint32_t makespan, double step_duration_sec, const ros::Time& start) {
  const double lasts = makespan * step_duration_sec;
  const double end_of_durations = std::numeric_limits<std::int32_t>::max();
  const double end_of_times = std::numeric_limits<std::uint32_t>::max();
  const double left = std::min(end_of_durations, end_of_times - start.toSec()) - 1;
  if (lasts <= left) return;
  throw OptionError("step_duration " + numeral(step_duration_sec) + " s: a plan of " +
                    counted(makespan, "step") + " lasts " + numeral(lasts) +
                    " s, but ROS time can hold " + numeral(std::max(left, 0.0)) + " s from now on");
}

}  // namespace split_mapf
