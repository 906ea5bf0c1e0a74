#include "rviz/player_panel.h"

#include <algorithm>
#include <string>

#include <rviz/config.h>
#include <rviz/visualization_manager.h>
#include <split_mapf/ReplayControl.h>
#include <QHBoxLayout>
#include <QSignalBlocker>
#include <QVBoxLayout>

#include "split_mapf/core/wording.h"

namespace split_mapf {
namespace {

using Request = ReplayControl::Request;

constexpr int kRefreshMs = 200;
constexpr double kTenths = 10;  // positions of the slider a step
constexpr double kMostTenths = 1e9;

QLabel* makeLabel(const char* name) {
  auto* label = new QLabel;
  label->setObjectName(name);
  label->setWordWrap(true);
  // A robot's id is anybody's text.
  label->setTextFormat(Qt::PlainText);
  label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  return label;
}

QString legendText() {
  QString text;
  for (const ShownState state : {ShownState::kMoving, ShownState::kWaiting, ShownState::kArrived,
                                 ShownState::kLate, ShownState::kAbsent, ShownState::kNoWay}) {
    const PackedColour colour = colourOf(state);
    text += QString("<font color='#%1%2%3'>\u25cf</font> %4 &nbsp;")
                .arg(colour & 255U, 2, 16, QChar('0'))
                .arg(colour >> 8U & 255U, 2, 16, QChar('0'))
                .arg(colour >> 16U & 255U, 2, 16, QChar('0'))
                .arg(nameOf(state));
  }
  return text;
}

}  // namespace

PlayerPanel::PlayerPanel(QWidget* parent)
    : rviz::Panel(parent), replay_([this](const std::string& fault) {
        QMetaObject::invokeMethod(link_fault_, "setText", Qt::QueuedConnection,
                                  Q_ARG(QString, QString::fromStdString(fault)));
      }) {
  auto* rows = new QVBoxLayout(this);
  add_display_ = new QPushButton("Add a display SplitMapf/Plan");
  add_display_->setObjectName("add_display");
  connect(add_display_, &QPushButton::clicked, this, [this] {
    if (display() == nullptr) vis_manager_->createDisplay(PlanDisplay::kClass, "Plan", true);
  });
  rows->addWidget(add_display_);
  rows->addLayout(makeButtons());
  time_ = new QSlider(Qt::Horizontal);
  time_->setObjectName("time");
  connect(time_, &QSlider::valueChanged, this, [this](int tenths) { seek(tenths); });
  rows->addWidget(time_);
  rows->addWidget(now_ = makeLabel("now"));
  rows->addLayout(makeSpeed());
  rows->addWidget(costs_ = makeLabel("costs"));
  rows->addWidget(outcome_ = makeLabel("outcome"));
  rows->addWidget(legend_ = makeLabel("legend"));
  legend_->setTextFormat(Qt::RichText);
  legend_->setText(legendText());
  rows->addLayout(makeSearch());
  rows->addWidget(robot_ = makeLabel("robot"));
  rows->addWidget(request_ = new RequestBox);
  rows->addLayout(makeLink());
  rows->addWidget(link_fault_ = makeLabel("link_fault"));
  rows->addStretch();
  connect(&timer_, &QTimer::timeout, this, [this] { refresh(); });
}

template <class Act>
QPushButton* PlayerPanel::makeButton(const char* name, const QString& text, Act act) {
  auto* button = new QPushButton(text);
  button->setObjectName(name);
  connect(button, &QPushButton::clicked, this, [this, act] {
    if (PlanDisplay* shown = display()) act(*shown);
    refresh();
  });
  return button;
}

QLayout* PlayerPanel::makeButtons() {
  auto* row = new QHBoxLayout;
  row->addWidget(makeButton("start", "|<", [this](PlanDisplay& shown) {
    shown.steer().seek(0);
    replay_.send(Request::SEEK, 0);
  }));
  row->addWidget(makeButton("back", "-1", [this](PlanDisplay& shown) { step(shown, -1); }));
  play_ = makeButton("play", "Play", [this](PlanDisplay& shown) { playOrPause(shown); });
  row->addWidget(play_);
  row->addWidget(makeButton("forward", "+1", [this](PlanDisplay& shown) { step(shown, 1); }));
  row->addWidget(makeButton("fit", "Fit", [](PlanDisplay& shown) {
    shown.follow({});
    shown.fitToMap();
  }));
  for (int k = 0; k < row->count(); ++k) {
    row->itemAt(k)->widget()->setMinimumWidth(36);
  }
  return row;
}

QLayout* PlayerPanel::makeSpeed() {
  auto* row = new QHBoxLayout;
  speed_ = new QDoubleSpinBox;
  speed_->setObjectName("speed");
  speed_->setRange(0, 10000);
  speed_->setPrefix("speed ");
  speed_->setSpecialValueText("speed: a minute at most");
  speed_->setToolTip("Times the plan's own pace");
  connect(speed_, qOverload<double>(&QDoubleSpinBox::valueChanged), this, [this](double speed) {
    if (PlanDisplay* shown = display()) shown->setSpeed(speed);
    if (speed > 0) replay_.send(Request::SPEED, speed);
  });
  row->addWidget(speed_);
  loop_ = new QCheckBox("loop");
  loop_->setObjectName("loop");
  connect(loop_, &QCheckBox::toggled, this, [this](bool loop) {
    if (PlanDisplay* shown = display()) shown->setLoop(loop);
    replay_.send(Request::LOOP, loop ? 1 : 0);
  });
  row->addWidget(loop_);
  return row;
}

QLayout* PlayerPanel::makeSearch() {
  auto* row = new QHBoxLayout;
  search_ = new QLineEdit;
  search_->setObjectName("search");
  search_->setPlaceholderText("robot");
  connect(search_, &QLineEdit::returnPressed, this, [this] { search(); });
  row->addWidget(search_);
  follow_ = new QPushButton("Follow");
  follow_->setObjectName("follow");
  connect(follow_, &QPushButton::clicked, this, [this] {
    PlanDisplay* shown = display();
    if (shown != nullptr && shown->followed()) {
      shown->follow({});
    } else {
      search();
    }
    refresh();
  });
  row->addWidget(follow_);
  return row;
}

QLayout* PlayerPanel::makeLink() {
  auto* row = new QHBoxLayout;
  linked_ = new QCheckBox("steer replay_node too");
  linked_->setObjectName("linked");
  service_ = new QLineEdit("/replay/control");
  service_->setObjectName("service");
  connect(linked_, &QCheckBox::toggled, this, [this] { link(); });
  connect(service_, &QLineEdit::editingFinished, this, [this] { link(); });
  row->addWidget(linked_);
  row->addWidget(service_);
  return row;
}

void PlayerPanel::onInitialize() {
  timer_.start(kRefreshMs);
  refresh();
}

void PlayerPanel::load(const rviz::Config& config) {
  rviz::Panel::load(config);
  bool linked = false;
  QString service;
  if (config.mapGetString("Replay Service", &service)) service_->setText(service);
  if (config.mapGetBool("Steer Replay", &linked)) linked_->setChecked(linked);
}

void PlayerPanel::save(rviz::Config config) const {
  rviz::Panel::save(config);
  config.mapSetValue("Replay Service", service_->text());
  config.mapSetValue("Steer Replay", linked_->isChecked());
}

PlanDisplay* PlayerPanel::display() const {
  return vis_manager_ == nullptr ? nullptr : PlanDisplay::find(*vis_manager_);
}

void PlayerPanel::playOrPause(PlanDisplay& shown) {
  if (shown.timeline().playing() && shown.timeline().position() < shown.timeline().steps()) {
    shown.steer().pause();
    replay_.send(Request::PAUSE);
  } else {
    shown.steer().play();
    replay_.send(Request::PLAY);
  }
}

void PlayerPanel::step(PlanDisplay& shown, double steps) {
  shown.steer().step(steps);
  replay_.send(Request::STEP, steps);
}

void PlayerPanel::seek(int tenths) {
  PlanDisplay* shown = display();
  if (shown == nullptr) return;
  shown->steer().seek(tenths / kTenths);
  replay_.send(Request::SEEK, shown->timeline().position());
}

void PlayerPanel::search() {
  PlanDisplay* shown = display();
  if (shown == nullptr || shown->scene() == nullptr) return;
  const std::string text = search_->text().trimmed().toStdString();
  const std::optional<std::size_t> found = shown->scene()->search(text);
  shown->follow(found);
  if (!found) robot_->setText("no robot " + QString::fromStdString(quote(text)));
}

void PlayerPanel::link() {
  const bool linked = linked_->isChecked();
  replay_.setService(linked ? service_->text().trimmed().toStdString() : "");
  link_fault_->clear();
  Q_EMIT configChanged();
}

void PlayerPanel::refresh() {
  PlanDisplay* shown = display();
  add_display_->setVisible(shown == nullptr);
  request_->refresh(shown);
  if (shown == nullptr) return;
  refreshTime(*shown);
  refreshTexts(*shown);
}

void PlayerPanel::refreshTime(const PlanDisplay& shown) {
  const ReplayTimeline& timeline = shown.timeline();
  const QSignalBlocker time_blocker(time_);
  const QSignalBlocker speed_blocker(speed_);
  const QSignalBlocker loop_blocker(loop_);
  time_->setMaximum(static_cast<int>(std::min(kMostTenths, kTenths * timeline.steps())));
  time_->setPageStep(std::max(1, time_->maximum() / 20));
  if (!time_->isSliderDown()) {
    time_->setValue(static_cast<int>(std::min(kMostTenths, kTenths * timeline.position())));
  }
  const bool runs = timeline.playing() && timeline.position() < timeline.steps();
  play_->setText(runs ? "Pause" : "Play");
  now_->setText(QString("step %1 of %2, %3 times its pace")
                    .arg(timeline.position(), 0, 'f', 1)
                    .arg(timeline.steps(), 0, 'f', 0)
                    .arg(timeline.speed(), 0, 'g', 3));
  if (!speed_->hasFocus()) speed_->setValue(shown.speed());
  loop_->setChecked(timeline.loop());
}

void PlayerPanel::refreshTexts(PlanDisplay& shown) {
  legend_->setVisible(shown.properties().style().colour_by == ColourBy::kState);
  outcome_->setText(QString::fromStdString(shown.outcome()));
  outcome_->setVisible(!shown.outcome().empty());
  const PlanScene* scene = shown.scene();
  if (scene == nullptr) {
    costs_->setText("no plan yet");
    return;
  }
  costs_->setText(QString("%1 robots, makespan %2, sum of costs %3")
                      .arg(scene->robots())
                      .arg(scene->makespan())
                      .arg(scene->sumOfCosts()));
  follow_->setText(shown.followed() ? "Leave" : "Follow");
  const std::optional<std::size_t> robot = shown.pointedAt() ? shown.pointedAt() : shown.followed();
  if (!robot) return;
  robot_->setText(QString::fromStdString(
      describe(shown.moment(), *robot, shown.properties().style().late_sec)));
}

}  // namespace split_mapf
