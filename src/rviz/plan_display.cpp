#include "rviz/plan_display.h"

#include <exception>

#include <ros/exceptions.h>
#include <ros/time.h>
#include <rviz/display_context.h>
#include <rviz/display_group.h>
#include <rviz/visualization_manager.h>

#include "ros/scene/layout_scene.h"
#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

using rviz::StatusProperty;

PlanDisplay* findIn(const rviz::DisplayGroup& group) {
  for (int row = 0; row < group.numDisplays(); ++row) {
    rviz::Display* display = group.getDisplayAt(row);
    if (auto* found = dynamic_cast<PlanDisplay*>(display)) return found;
    const auto* inner = dynamic_cast<rviz::DisplayGroup*>(display);
    PlanDisplay* found = inner == nullptr ? nullptr : findIn(*inner);
    if (found != nullptr) return found;
  }
  return nullptr;
}

}  // namespace

// Properties belong to the display, as to every parent of theirs.
PlanDisplay::PlanDisplay() : properties_(std::make_unique<DisplayProperties>(this)) {
  for (int row = 0; row < numChildren(); ++row) {
    connect(childAt(row), &rviz::Property::changed, this,
            [this] { changed_ = topics_changed_ = true; });
  }
  for (rviz::Property* of_regions : {static_cast<rviz::Property*>(properties_->phase),
                                     static_cast<rviz::Property*>(properties_->regions)}) {
    connect(of_regions, &rviz::Property::changed, this, [this] { paintRegions(); });
  }
  connect(properties_->graph, &rviz::Property::changed, this, [this] { paintGraph(); });
  connect(properties_->speed, &rviz::Property::changed, this,
          [this] { timeline_.setSpeed(static_cast<double>(properties_->speed->getFloat())); });
  connect(properties_->loop, &rviz::Property::changed, this,
          [this] { timeline_.setLoop(properties_->loop->getBool()); });
}

PlanDisplay::~PlanDisplay() = default;

PlanDisplay* PlanDisplay::find(rviz::DisplayContext& context) {
  const rviz::DisplayGroup* root = context.getRootDisplayGroup();
  return root == nullptr ? nullptr : findIn(*root);
}

rviz::VisualizationManager* PlanDisplay::manager() const {
  return dynamic_cast<rviz::VisualizationManager*>(context_);
}

void PlanDisplay::onInitialize() {
  feed_ = std::make_unique<PlanFeed>(threaded_nh_);
  layers_ = std::make_unique<SceneLayers>(*context_, scene_node_);
  labels_ = std::make_unique<RobotLabels>(layers_->node(SceneLayer::kMarks));
  if (manager() != nullptr && manager()->getRenderPanel() != nullptr) {
    cursor_ = std::make_unique<CursorWatch>(*manager()->getRenderPanel());
  }
  setStatus(StatusProperty::Warn, "Plan", "No plan has come yet.");
}

void PlanDisplay::onEnable() {
  topics_changed_ = true;
  // Time that nobody saw pass is not made up for.
  timeline_.hold();
}

void PlanDisplay::onDisable() { feed_->unsubscribe(); }

void PlanDisplay::reset() {
  Display::reset();
  feed_->unsubscribe();
  topics_changed_ = true;
  if (!scene_) setStatus(StatusProperty::Warn, "Plan", "No plan has come yet.");
  changed_ = true;
}

void PlanDisplay::setTopic(const QString& topic, const QString& /*datatype*/) {
  properties_->plan->setString(topic);
}

void PlanDisplay::subscribe() {
  if (!topics_changed_) return;
  topics_changed_ = false;
  try {
    feed_->subscribe(properties_->topics());
    deleteStatus("Topics");
  } catch (const ros::Exception& error) {
    setStatusStd(StatusProperty::Error, "Topics", error.what());
  }
}

void PlanDisplay::takeNews() {
  FeedNews news = feed_->takeNews();
  if (!news.plan_fault.empty()) {
    // The plan that is shown, if any, stays.
    setStatusStd(StatusProperty::Error, "Plan", "a plan that cannot be shown: " + news.plan_fault);
  }
  if (news.scene) takeScene(news.scene);
  if (news.outcome) outcome_ = *news.outcome;
  if (news.layout) {
    layout_ = news.layout;
    paintRegions();
  }
  if (news.roadmap) {
    roadmap_ = news.roadmap;
    paintGraph();
  }
  if (!scene_) return;
  if (news.fleet) fleet_.take(*news.fleet, *scene_);
  for (const auto& [id, progress] : news.progress) fleet_.take(*progress, *scene_);
  changed_ = changed_ || news.fleet || !news.progress.empty();
}

void PlanDisplay::takeScene(const std::shared_ptr<const PlanScene>& scene) {
  const std::string followed = scene_ && followed_ ? scene_->id(*followed_) : "";
  scene_ = scene;
  followed_ = followed.empty() ? std::nullopt : scene_->find(followed);
  pointed_at_.reset();
  fleet_.begin(scene_->robots());
  timeline_.load(scene_->steps(), scene_->stepDurationSec());
  const MapGeometry& geometry = scene_->geometry();
  for (const SceneLayer layer : {SceneLayer::kTrails, SceneLayer::kGoals, SceneLayer::kRobots,
                                 SceneLayer::kWaits, SceneLayer::kMarks}) {
    layers_->attach(layer, geometry.frame(), geometry.info().origin.position);
  }
  const std::string said = counted(scene_->robots(), "robot") + ", makespan " +
                           std::to_string(scene_->makespan()) + ", sum of costs " +
                           std::to_string(scene_->sumOfCosts());
  const std::string& doubt = scene_->doubt();
  setStatusStd(doubt.empty() ? StatusProperty::Ok : StatusProperty::Warn, "Plan",
               doubt.empty() ? said : said + "; " + doubt);
  changed_ = true;
}

void PlanDisplay::paintRegions() {
  if (!layers_) return;
  QuadMesh& mesh = layers_->begin(SceneLayer::kLayout);
  try {
    const auto phase = static_cast<std::size_t>(properties_->phase->getInt());
    if (properties_->regions->getBool() && layout_ && phase < layout_->phases.size()) {
      paintLayout(*layout_, phase, mesh);
      layers_->attach(SceneLayer::kLayout, layout_->header.frame_id, layout_->grid.origin.position);
    }
    deleteStatus("Layout");
  } catch (const std::exception& error) {
    mesh.clear();
    setStatusStd(StatusProperty::Error, "Layout",
                 std::string("a layout that cannot be shown: ") + error.what());
  }
  layers_->present(SceneLayer::kLayout);
}

void PlanDisplay::paintGraph() {
  if (!layers_) return;
  QuadMesh& mesh = layers_->begin(SceneLayer::kRoadmap);
  std::string frame;
  geometry_msgs::Point origin;
  if (properties_->graph->getBool() && roadmap_ && findRoadmap(*roadmap_, frame, origin)) {
    layers_->attach(SceneLayer::kRoadmap, frame, origin);
    paintRoadmap(*roadmap_, origin, mesh);
  }
  layers_->present(SceneLayer::kRoadmap);
}

void PlanDisplay::update(float /*wall_dt*/, float /*ros_dt*/) {
  subscribe();
  takeNews();
  followFrames();
  if (scene_) {
    timeline_.advance(ros::SteadyTime::now().toSec());
    if (!fitted_ && properties_->fit->getBool()) fitToMap();
    fitted_ = true;
    watchCursor();
  }
  repaint();
}

}  // namespace split_mapf
