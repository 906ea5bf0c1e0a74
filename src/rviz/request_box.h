#pragma once

#include <QDoubleSpinBox>
#include <QGroupBox>
#include <QLabel>
#include <QPointer>
#include <QPushButton>

#include "rviz/plan_asker.h"
#include "rviz/plan_display.h"

namespace split_mapf {

/// The part of the panel that asks for a plan of the robots that somebody has placed. Of the GUI
/// thread.
class RequestBox : public QGroupBox {
 public:
  explicit RequestBox(QWidget* parent = nullptr);

  /// Shows what there is to ask for. @param shown  the display; null: none is there.
  void refresh(PlanDisplay* shown);

 private:
  void ask();
  void takeOver();
  void clear();

  QPointer<PlanDisplay> shown_;  // of the last refresh; null once that display is gone
  QLabel* robots_;
  QLabel* said_;
  QDoubleSpinBox* time_limit_;
  QPushButton* ask_;
  QPushButton* take_over_;
  QPushButton* clear_;
  // Last: its thread speaks to the widgets.
  PlanAsker asker_;
};

}  // namespace split_mapf
