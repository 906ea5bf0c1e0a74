#pragma once

#include <cstdint>

#include <rviz/panel.h>
#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSlider>
#include <QTimer>

#include "rviz/plan_display.h"
#include "rviz/replay_link.h"
#include "rviz/request_box.h"

namespace split_mapf {

/// The panel SplitMapf/Player: steers the first display SplitMapf/Plan of this rviz, and nobody
/// else's but where it is linked to a replay_node. It shows what the display does and keeps no
/// state of its own but its settings. Of the GUI thread.
class PlayerPanel : public rviz::Panel {
 public:
  explicit PlayerPanel(QWidget* parent = nullptr);

  void onInitialize() override;
  void load(const rviz::Config& config) override;
  void save(rviz::Config config) const override;

 private:
  QLayout* makeButtons();
  QLayout* makeSpeed();
  QLayout* makeSearch();
  QLayout* makeLink();
  /// A button whose object name is `name`, so that tests find it. @param act  takes the display.
  template <class Act>
  QPushButton* makeButton(const char* name, const QString& text, Act act);

  PlanDisplay* display() const;
  void refresh();
  void refreshTime(const PlanDisplay& shown);
  void refreshTexts(PlanDisplay& shown);
  void playOrPause(PlanDisplay& shown);
  void step(PlanDisplay& shown, double steps);
  void search();
  void link();
  void seek(int tenths);

  QPushButton* play_;
  QPushButton* follow_;
  QPushButton* add_display_;
  QSlider* time_;
  QDoubleSpinBox* speed_;
  QCheckBox* loop_;
  QCheckBox* linked_;
  QLineEdit* service_;
  QLineEdit* search_;
  QLabel* now_;
  QLabel* costs_;
  QLabel* outcome_;
  QLabel* legend_;
  QLabel* robot_;
  QLabel* link_fault_;
  RequestBox* request_;
  QTimer timer_;
  // Last: its thread speaks to the widgets.
  ReplayLink replay_;
};

}  // namespace split_mapf
