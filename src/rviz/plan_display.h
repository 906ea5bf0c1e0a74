#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include <rviz/display.h>

#include "ros/replay/replay_timeline.h"
#include "ros/scene/fleet_standing.h"
#include "ros/scene/plan_scene.h"
#include "ros/scene/robot_draft.h"
#include "rviz/cursor_watch.h"
#include "rviz/display_properties.h"
#include "rviz/plan_feed.h"
#include "rviz/robot_labels.h"
#include "rviz/scene_layers.h"

namespace rviz {
class VisualizationManager;
}

namespace split_mapf {

/// The display SplitMapf/Plan: draws a plan at any moment by itself, from the one message that
/// holds it, and what its execution says of it. It plays by itself; panel and tool steer it. Of the
/// GUI thread.
class PlanDisplay : public rviz::Display {
 public:
  static constexpr const char* kClass = "SplitMapf/Plan";

  PlanDisplay();
  ~PlanDisplay() override;

  /// The first display of this kind in rviz, to which panel and tool belong; null: none.
  static PlanDisplay* find(rviz::DisplayContext& context);

  void update(float wall_dt, float ros_dt) override;
  void reset() override;
  void setTopic(const QString& topic, const QString& datatype) override;

  /// What is shown; null: no plan has come yet.
  const PlanScene* scene() const { return scene_.get(); }
  /// The moment that is shown. @pre scene() is not null.
  SceneMoment moment() const { return {*scene_, fleet_, timeline_.position()}; }
  const ReplayTimeline& timeline() const { return timeline_; }
  /// Steering; what it changes is drawn with the next frame.
  ReplayTimeline& steer() { return timeline_; }
  /// Times the plan's own pace; 0: as ReplayTimeline::setSpeed() has it.
  double speed() const { return static_cast<double>(properties_->speed->getFloat()); }
  void setSpeed(double speed) { properties_->speed->setValue(speed); }
  void setLoop(bool loop) { properties_->loop->setValue(loop); }
  DisplayProperties& properties() { return *properties_; }

  void fitToMap();
  /// The view goes with a robot from now on. @pre robot < scene()->robots(), or empty: no more.
  void follow(std::optional<std::size_t> robot);
  std::optional<std::size_t> followed() const { return followed_; }
  /// The robot under the mouse.
  std::optional<std::size_t> pointedAt() const { return pointed_at_; }
  /// The latest outcome of the action, one sentence; empty: none yet.
  const std::string& outcome() const { return outcome_; }

  /// Robots for the next plan. Call placedChanged() after a change.
  RobotDraft& placed() { return placed_; }
  void placedChanged() { placed_changed_ = true; }
  /// The point of the map under a place of the view, as placed() counts it; it gets its frame here.
  std::optional<ScenePoint> placeAt(QPoint place);
  /// [m] of which robots are placed, and how far from them a click still means them.
  float placedRadius() const;

 protected:
  void onInitialize() override;
  void onEnable() override;
  void onDisable() override;
  void fixedFrameChanged() override { changed_ = true; }

 private:
  rviz::VisualizationManager* manager() const;
  void subscribe();
  void takeNews();
  void takeScene(const std::shared_ptr<const PlanScene>& scene);
  void paintRegions();
  void paintGraph();
  void followFrames();
  void repaint();
  void paintMarks(const SceneStyle& style);
  void paintPlaced();
  void label();
  void watchCursor();

  std::unique_ptr<DisplayProperties> properties_;
  std::unique_ptr<PlanFeed> feed_;
  std::shared_ptr<const PlanScene> scene_;
  PlanLayoutConstPtr layout_;
  visualization_msgs::MarkerArrayConstPtr roadmap_;
  FleetStanding fleet_;
  ReplayTimeline timeline_;
  RobotDraft placed_;
  std::unique_ptr<SceneLayers> layers_;
  std::unique_ptr<RobotLabels> labels_;
  std::unique_ptr<CursorWatch> cursor_;
  std::optional<std::size_t> followed_;
  std::optional<std::size_t> pointed_at_;
  std::string outcome_;
  double shown_step_ = -1;
  float metres_per_pixel_ = 0;
  bool topics_changed_ = true;
  bool changed_ = true;         // something besides time, of what is drawn
  bool placed_changed_ = true;  // of what is placed
  bool fitted_ = false;
};

}  // namespace split_mapf
