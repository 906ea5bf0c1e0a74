#pragma once

#include <functional>
#include <memory>
#include <string>

#include <rviz/display.h>
#include <rviz/render_panel.h>
#include <rviz/visualization_frame.h>
#include <QApplication>
#include <QLabel>
#include <QString>

namespace split_mapf::test {

/// rviz as its program starts it, with a configuration; plug-ins are found and loaded as by any
/// rviz.
class RvizWindow {
 public:
  explicit RvizWindow(const QString& configuration);

  /// Lets the window live until a condition holds. False after half a minute.
  bool waitFor(const std::function<bool()>& condition);
  /// Lets it draw a number of frames.
  bool drawFrames(std::uint64_t frames);

  /// A widget by its object's name. Fails the test and returns nullptr when it is not there.
  template <class Widget>
  Widget* widget(const char* name) {
    return frame_.findChild<Widget*>(name);
  }
  std::string textOf(const char* label) {
    const auto* found = widget<QLabel>(label);
    return found == nullptr ? "" : found->text().toStdString();
  }
  bool waitForText(const char* label, const std::string& part);

  rviz::Display* display(const QString& class_id);
  /// The status of a display, of one name; empty: none.
  std::string statusOf(const QString& class_id, const QString& name);
  /// Chooses a tool of this class. False: there is none.
  bool chooseTool(const QString& class_id);
  /// Presses and releases a button of the mouse over the 3D view [pixels].
  void clickAt(int x, int y, Qt::MouseButton button = Qt::LeftButton);
  /// Drags with the left button.
  void drag(QPoint from, QPoint to);
  void moveMouse(int x, int y);
  /// Out of the 3D view.
  void takeMouseAway();
  rviz::RenderPanel& view();
  rviz::VisualizationManager& manager() { return *frame_.getManager(); }

 private:
  void send(QEvent::Type type, QPoint place, Qt::MouseButton button, Qt::MouseButtons down);

  rviz::VisualizationFrame frame_;
};

}  // namespace split_mapf::test
