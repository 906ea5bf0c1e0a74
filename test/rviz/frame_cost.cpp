// Measures what a plan costs rviz: CPU seconds a frame with the display SplitMapf/Plan and without
// it, in turns, on whatever plan is published meanwhile.
//
// usage: rviz_frame_cost CONFIGURATION [SECONDS A TURN] [TURNS]

#include <cstdio>
#include <cstdlib>
#include <ctime>

#include <ros/ros.h>
#include <rviz/display.h>
#include <rviz/visualization_manager.h>
#include <QElapsedTimer>
#include <QPushButton>

#include "rviz/rviz_window.h"

namespace {

using split_mapf::test::RvizWindow;

struct Cost {
  double cpu_sec = 0;
  double frames = 0;
};

void measure(RvizWindow& window, double seconds, Cost& cost) {
  window.drawFrames(5);
  const std::clock_t begin = std::clock();
  const auto frames = window.manager().getFrameCount();
  QElapsedTimer clock;
  clock.start();
  window.waitFor([&] { return static_cast<double>(clock.elapsed()) >= 1000 * seconds; });
  cost.cpu_sec += static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  cost.frames += static_cast<double>(window.manager().getFrameCount() - frames);
}

void print(const char* what, const Cost& cost) {
  std::printf("%-16s %6.0f frames, %6.2f CPU s: %6.1f frames a CPU second\n", what, cost.frames,
              cost.cpu_sec, cost.frames / cost.cpu_sec);
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "rviz_frame_cost", ros::init_options::AnonymousName);
  QApplication application(argc, argv);
  if (argc < 2) return 2;
  const ros::NodeHandle keep_alive;
  const double seconds = argc > 2 ? std::atof(argv[2]) : 10;
  const int turns = argc > 3 ? std::atoi(argv[3]) : 2;
  RvizWindow window(argv[1]);
  if (!window.waitForText("costs", "robots, makespan")) return 1;
  std::printf("%s\n", window.textOf("costs").c_str());
  rviz::Display* display = window.display("SplitMapf/Plan");
  window.drawFrames(30);
  Cost with;
  Cost without;
  for (int turn = 0; turn < turns; ++turn) {
    display->setEnabled(false);
    measure(window, seconds, without);
    display->setEnabled(true);
    window.widget<QPushButton>("start")->click();
    measure(window, seconds, with);
  }
  std::printf("%s\n", window.textOf("now").c_str());
  print("without robots", without);
  print("with robots", with);
  std::printf("with robots %.0f %% of the frames a CPU second\n",
              100 * (with.frames / with.cpu_sec) / (without.frames / without.cpu_sec));
  return 0;
}
