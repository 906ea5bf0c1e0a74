#include "ros/strange_goals.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "ros/goal_messages.h"

namespace split_mapf::test {
namespace {

constexpr double kShortLimitSec = 0.5;
constexpr std::size_t kMebi = std::size_t{1} << 20;
constexpr std::uint32_t kManyRobots = 20000;
constexpr std::uint32_t kVeryManyRobots = 100000;
constexpr std::uint32_t kLargestSide = 8000;

nav_msgs::OccupancyGrid freeMap(std::uint32_t width, std::uint32_t height) {
  nav_msgs::OccupancyGrid map;
  map.header.frame_id = "map";
  map.info.resolution = 1;
  map.info.width = width;
  map.info.height = height;
  map.info.origin.orientation.w = 1;
  map.data.assign(std::size_t{width} * height, 0);
  return map;
}

}  // namespace

const std::vector<StrangeGoals::Kind>& StrangeGoals::kinds() {
  static const std::vector<Kind> kinds = {
      {"text", 12, &StrangeGoals::spoilText},
      {"poses", 14, &StrangeGoals::spoilPoses},
      {"map", 16, &StrangeGoals::spoilMap},
      {"options", 18, &StrangeGoals::spoilOptions},
      {"split", 8, &StrangeGoals::spoilSplit},
      {"stamps", 6, &StrangeGoals::spoilStamps},
      {"crowd", 3, &StrangeGoals::crowd},
      {"large map", 3, &StrangeGoals::enlargeMap},
      {"repeated text", 3, &StrangeGoals::repeatText},
      {"poses asked for", 5, &StrangeGoals::askForPoses},
      {"noise", 12, &StrangeGoals::drawNoise},
  };
  return kinds;
}

StrangeGoals::StrangeGoals(std::uint64_t seed, double server_limit_sec)
    : random_(seed), server_limit_sec_(server_limit_sec) {}

StrangeGoal StrangeGoals::draw() {
  std::uint64_t total = 0;
  for (const Kind& kind : kinds()) total += kind.weight;
  std::uint64_t drawn = below(total);
  const Kind* chosen = kinds().data();
  for (; drawn >= chosen->weight; ++chosen) drawn -= chosen->weight;
  StrangeGoal strange;
  strange.kind = chosen->name;
  strange.goal = smallGoal();
  strange.goal.options.time_limit = kShortLimitSec;
  (this->*chosen->spoil)(strange);
  strange.cancelled = oneIn(8);
  // Whatever a goal names that is no limit is refused at once, or is the server's own.
  const double named = strange.goal.options.time_limit;
  strange.limit_sec = named > 0 && named <= server_limit_sec_ ? named : server_limit_sec_;
  return strange;
}

double StrangeGoals::strangeNumber() {
  using Limits = std::numeric_limits<double>;
  return pick<double>({Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity(), Limits::max(),
                       Limits::lowest(), Limits::denorm_min(), -Limits::denorm_min(), 0, -0.0, -1,
                       1e9, 1e18, -1e9, 4294967296.0, 0.5, 1e-9});
}

std::string StrangeGoals::strangeText() {
  switch (below(8)) {
    case 0:
      return std::string(kMebi, 'x');
    case 1:
      return std::string(200 + below(200), 'y');
    case 2:
      return "%s%n%100000d";
    case 3:
      return std::string("\0\xff\xfe\xc3\x28\n\r\x1b[31m", 12);
    case 4:
      return "../../../etc/passwd";
    case 5:
      return "\xf0\x9f\xa4\x96 robot/one two";
    case 6:
      return "/" + std::string(1 + below(4), '/');
    default: {
      std::string noise(below(60), ' ');
      for (char& c : noise) c = static_cast<char>(below(256));
      return noise;
    }
  }
}

void StrangeGoals::makeStrange(geometry_msgs::PoseStamped& pose) {
  switch (below(6)) {
    case 0:
      pose.pose.position.x = strangeNumber();
      break;
    case 1:
      pose.pose.position.y = strangeNumber();
      break;
    case 2:
      pose.pose.position.z = strangeNumber();
      break;
    case 3:
      pose.pose.orientation.w = strangeNumber();
      break;
    case 4:
      pose.pose.orientation.z = strangeNumber();
      break;
    default:
      pose.header.frame_id = strangeText();
  }
}

void StrangeGoals::spoilText(StrangeGoal& strange) {
  PlanPathsGoal& goal = strange.goal;
  const std::vector<std::string*> places = {
      &goal.map.header.frame_id, &goal.robots[0].robot_id, &goal.robots[1].start.header.frame_id,
      &goal.options.solver,      &goal.options.split,      &goal.options.objective};
  *pick(places) = strangeText();
  if (oneIn(3)) goal.options.solver_options.assign(1 + below(100000), strangeText().substr(0, 40));
  if (oneIn(3)) goal.options.split_options.assign(1 + below(5), strangeText());
  if (oneIn(4)) goal.robots[1].robot_id = goal.robots[0].robot_id;
}

void StrangeGoals::spoilPoses(StrangeGoal& strange) {
  for (std::uint64_t left = 1 + below(3); left > 0; --left) {
    RobotTask& task = strange.goal.robots[below(2)];
    makeStrange(oneIn(2) ? task.start : task.goal);
  }
  if (oneIn(4)) strange.goal.robots[1].goal = strange.goal.robots[0].goal;
}

void StrangeGoals::spoilMap(StrangeGoal& strange) {
  nav_msgs::OccupancyGrid& map = strange.goal.map;
  switch (below(8)) {
    case 0:
      map.data.resize(below(100));
      break;
    case 1:
      map.info.width = pick<std::uint32_t>({0, 1, 65536, 0x80000000U, 0xffffffffU});
      break;
    case 2:
      map.info.width = map.info.height = 65536;  // the product is 0 in 32 bits
      map.data.clear();
      break;
    case 3:
      map.info.resolution = static_cast<float>(strangeNumber());
      break;
    case 4:
      map.info.origin.position.x = strangeNumber();
      map.info.origin.position.y = strangeNumber();
      break;
    case 5:
      map.info.origin.orientation.z = strangeNumber();
      map.info.origin.orientation.x = oneIn(2) ? 0 : strangeNumber();
      break;
    case 6:
      for (std::int8_t& cell : map.data) cell = static_cast<std::int8_t>(below(256));
      break;
    default:
      map.data.clear();
      map.info.height = 0;
  }
}

void StrangeGoals::spoilOptions(StrangeGoal& strange) {
  PlanOptions& options = strange.goal.options;
  const std::vector<double*> numbers = {
      &options.suboptimality, &options.time_limit,    &options.refine_time,
      &options.robot_radius,  &options.cell_size,     &options.step_duration,
      &options.clearance,     &options.snap_distance, &options.robot_speed};
  *pick(numbers) = strangeNumber();
  if (oneIn(3)) *pick(numbers) = strangeNumber();
  if (oneIn(4)) options.seed = 0xffffffffU;
  if (oneIn(4)) options.threads = pick<std::uint32_t>({1, 1000, 0x80000000U, 0xffffffffU});
  if (oneIn(4)) options.unknown_space = static_cast<std::uint8_t>(below(256));
  if (oneIn(4)) options.occupied_threshold = static_cast<std::int8_t>(below(256));
  if (oneIn(6)) options.passages = static_cast<std::uint8_t>(below(256));
  if (oneIn(6)) strange.goal.robots.front().radius = strangeNumber();
  options.fill_poses = static_cast<std::uint8_t>(oneIn(3));
}

void StrangeGoals::spoilSplit(StrangeGoal& strange) {
  strange.goal.options.split = pick<std::string>(
      {"999999999t", "99999999999999999999t", "1000x1000s", "0t", "t(0.5,nan)", "t(inf)",
       "4294967295x4294967295s", "s", "t", "4s99999t", "t(1e-300,1)", "-1t", "2x2s4t,", "36s"});
  const std::string option = pick<std::string>(
      {"buffer=99999999999x1", "lambda1=nan", "lambda2=1e999",
       "variant=", "assignment=greedy=matching", "compaction=maybe", "=", "buffer=-1x-1"});
  if (oneIn(2)) strange.goal.options.split_options.push_back(option);
}

void StrangeGoals::spoilStamps(StrangeGoal& strange) {
  const ros::Time last(0xffffffffU, 999999999);
  strange.goal.map.header.stamp = last;
  strange.goal.map.info.map_load_time = last;
  RobotTask& task = strange.goal.robots[0];
  task.start.header.frame_id = oneIn(2) ? "nowhere" : "map";
  task.start.header.stamp = last;
  task.goal.header.stamp.nsec = 0xffffffffU;
}

void StrangeGoals::crowd(StrangeGoal& strange) {
  PlanPathsGoal& goal = strange.goal;
  const std::uint32_t robots = pick<std::uint32_t>({2000, kManyRobots, kVeryManyRobots});
  const std::uint32_t side = pick<std::uint32_t>({6, 100, 400});
  goal.map = freeMap(side, side);
  goal.robots.assign(robots, goal.robots.front());
  for (std::uint32_t i = 0; i < robots; ++i) {
    RobotTask& task = goal.robots[i];
    task.robot_id = oneIn(1000) ? "twin" : std::to_string(i);
    const std::uint32_t column = i % side;
    const std::uint32_t row = i % (side * side) / side;
    task.start = poseAt(column + 0.5, row + 0.5);
    task.goal = poseAt(side - column - 0.5, row + 0.5);
  }
}

void StrangeGoals::enlargeMap(StrangeGoal& strange) {
  const std::uint32_t side = pick<std::uint32_t>({1000, 2000, 4000, kLargestSide});
  PlanPathsGoal& goal = strange.goal;
  goal.map = freeMap(side, side);
  goal.robots[0] = taskBetween("a", poseAt(0.5, 0.5), poseAt(side - 0.5, side - 0.5));
  goal.robots[1] = taskBetween("b", poseAt(side - 0.5, side - 0.5), poseAt(0.5, 0.5));
  if (!oneIn(3)) return;
  for (std::uint32_t y = 1; y < side; y += 2) {  // a serpentine
    const std::uint32_t gap = y % 4 == 1 ? side - 1 : 0;
    for (std::uint32_t x = 0; x < side; ++x) {
      goal.map.data[std::size_t{y} * side + x] = static_cast<std::int8_t>(x == gap ? 0 : 100);
    }
  }
  goal.robots.resize(1);
  goal.robots[0].goal = poseAt(0.5, side - 1 - (side - 1) % 2 + 0.5);
}

void StrangeGoals::repeatText(StrangeGoal& strange) {
  crowd(strange);
  PlanPathsGoal& goal = strange.goal;
  const std::size_t robots = std::min<std::size_t>(goal.robots.size(), kManyRobots);
  goal.robots.resize(robots);
  goal.map.header.frame_id.assign(kMebi, 'f');
  for (RobotTask& task : goal.robots) {
    task.start.header.frame_id = oneIn(2) ? "" : "elsewhere";
    task.goal.header.frame_id = "";
  }
}

void StrangeGoals::askForPoses(StrangeGoal& strange) {
  PlanPathsGoal& goal = strange.goal;
  const std::uint32_t side = pick<std::uint32_t>({6, 60, 300});
  goal.map = freeMap(side, side);
  goal.map.header.frame_id.assign(pick<std::size_t>({3, 256, kMebi}), 'm');
  goal.robots.clear();
  for (std::uint32_t y = 0; y < side; ++y) {
    goal.robots.push_back(
        taskBetween("", poseAt(0.5, y + 0.5), poseAt(side - 0.5, side - y - 0.5)));
    goal.robots.back().start.header.frame_id = goal.robots.back().goal.header.frame_id = "";
  }
  goal.options.fill_poses = 1;
  goal.options.step_duration = strangeNumber();
  goal.options.time_limit = 2;
}

void StrangeGoals::drawNoise(StrangeGoal& strange) {
  PlanPathsGoal& goal = strange.goal;
  const auto width = static_cast<std::uint32_t>(1 + below(12));
  const auto height = static_cast<std::uint32_t>(1 + below(12));
  goal.map = freeMap(width, height);
  for (std::int8_t& cell : goal.map.data) {
    cell = static_cast<std::int8_t>(oneIn(4) ? 100 : (oneIn(9) ? -1 : 0));
  }
  goal.robots.resize(below(2 + width * height / 2));
  for (RobotTask& task : goal.robots) {
    task = taskBetween("", poseAt(below(width) + 0.5, below(height) + 0.5),
                       poseAt(below(width) + 0.5, below(height) + 0.5));
  }
  if (oneIn(3)) goal.options.robot_radius = pick<double>({0.1, 0.3, 0.49, 0.8});
  goal.options.refine_time = oneIn(3) ? 0.3 : 0;
  goal.options.objective = oneIn(2) ? "sum_of_costs" : "makespan";
  goal.options.solver = pick<std::string>({"", "ecbs", "ilp", "lacam", "prioritized"});
  goal.options.split = pick<std::string>({"", "2t", "4s", "2x1s3t"});
}

}  // namespace split_mapf::test
