#include "rviz/request_box.h"

#include <QHBoxLayout>
#include <QVBoxLayout>

namespace split_mapf {

RequestBox::RequestBox(QWidget* parent)
    : QGroupBox("Ask for a plan", parent),
      robots_(new QLabel),
      said_(new QLabel),
      time_limit_(new QDoubleSpinBox),
      ask_(new QPushButton("Plan")),
      take_over_(new QPushButton("Take over")),
      clear_(new QPushButton("Clear")),
      asker_([this](const std::string& text) {
        QMetaObject::invokeMethod(said_, "setText", Qt::QueuedConnection,
                                  Q_ARG(QString, QString::fromStdString(text)));
      }) {
  ask_->setObjectName("ask");
  take_over_->setObjectName("take_over");
  take_over_->setToolTip("Robots of the plan, from where they are now to their goals");
  clear_->setObjectName("clear");
  said_->setObjectName("said");
  said_->setTextFormat(Qt::PlainText);
  robots_->setObjectName("placed");
  for (QLabel* label : {robots_, said_}) label->setWordWrap(true);
  time_limit_->setObjectName("time_limit");
  time_limit_->setRange(0, 100000);
  time_limit_->setSuffix(" s at most");
  time_limit_->setSpecialValueText("the planner's time limit");
  auto* rows = new QVBoxLayout(this);
  rows->addWidget(robots_);
  auto* buttons = new QHBoxLayout;
  for (QPushButton* button : {ask_, take_over_, clear_}) buttons->addWidget(button);
  rows->addLayout(buttons);
  rows->addWidget(time_limit_);
  rows->addWidget(said_);
  connect(ask_, &QPushButton::clicked, this, [this] { ask(); });
  connect(take_over_, &QPushButton::clicked, this, [this] { takeOver(); });
  connect(clear_, &QPushButton::clicked, this, [this] { clear(); });
}

void RequestBox::refresh(PlanDisplay* shown) {
  shown_ = shown;
  setEnabled(shown != nullptr);
  if (shown == nullptr) return;
  asker_.choose(shown->properties().action->getStdString());
  const RobotDraft& placed = shown->placed();
  ask_->setEnabled(placed.complete() > 0);
  clear_->setEnabled(!placed.all().empty());
  take_over_->setEnabled(shown->scene() != nullptr);
  robots_->setText(placed.all().empty()
                       ? QString("place starts and goals with the tool Place Robots")
                       : QString("%1 robots placed, %2 of them with a goal")
                             .arg(placed.all().size())
                             .arg(placed.complete()));
}

void RequestBox::ask() {
  if (shown_ != nullptr) asker_.ask(shown_->placed().tasks(), time_limit_->value());
}

void RequestBox::takeOver() {
  if (shown_ == nullptr || shown_->scene() == nullptr) return;
  shown_->placed().takeOver(shown_->moment());
  shown_->placedChanged();
  refresh(shown_);
}

void RequestBox::clear() {
  if (shown_ == nullptr) return;
  shown_->placed().begin("", {});
  shown_->placedChanged();
  refresh(shown_);
}

}  // namespace split_mapf
