#include "rviz/rviz_window.h"

#include <rviz/display_group.h>
#include <rviz/properties/status_list.h>
#include <rviz/tool.h>
#include <rviz/tool_manager.h>
#include <rviz/visualization_manager.h>
#include <QElapsedTimer>
#include <QMouseEvent>

namespace split_mapf::test {
namespace {

constexpr int kPatienceMs = 30000;

}  // namespace

RvizWindow::RvizWindow(const QString& configuration) {
  frame_.setApp(qApp);
  frame_.setSplashPath("");
  frame_.initialize(configuration);
  frame_.show();
}

bool RvizWindow::waitFor(const std::function<bool()>& condition) {
  QElapsedTimer clock;
  clock.start();
  while (!condition()) {
    if (clock.elapsed() > kPatienceMs) return false;
    QApplication::processEvents(QEventLoop::WaitForMoreEvents, 20);
  }
  return true;
}

bool RvizWindow::drawFrames(std::uint64_t frames) {
  const std::uint64_t end = manager().getFrameCount() + frames;
  return waitFor([&] { return manager().getFrameCount() >= end; });
}

bool RvizWindow::waitForText(const char* label, const std::string& part) {
  return waitFor([&] { return textOf(label).find(part) != std::string::npos; });
}

rviz::Display* RvizWindow::display(const QString& class_id) {
  rviz::DisplayGroup* group = manager().getRootDisplayGroup();
  for (int row = 0; row < group->numDisplays(); ++row) {
    if (group->getDisplayAt(row)->getClassId() == class_id) return group->getDisplayAt(row);
  }
  return nullptr;
}

std::string RvizWindow::statusOf(const QString& class_id, const QString& name) {
  rviz::Display* found = display(class_id);
  for (int row = 0; found != nullptr && row < found->numChildren(); ++row) {
    auto* statuses = qobject_cast<rviz::StatusList*>(found->childAt(row));
    for (int k = 0; statuses != nullptr && k < statuses->numChildren(); ++k) {
      rviz::Property* status = statuses->childAt(k);
      if (status->getName() == name) return status->getValue().toString().toStdString();
    }
  }
  return "";
}

bool RvizWindow::chooseTool(const QString& class_id) {
  rviz::ToolManager* tools = manager().getToolManager();
  for (int k = 0; k < tools->numTools(); ++k) {
    if (tools->getTool(k)->getClassId() != class_id) continue;
    tools->setCurrentTool(tools->getTool(k));
    return true;
  }
  return false;
}

rviz::RenderPanel& RvizWindow::view() { return *manager().getRenderPanel(); }

void RvizWindow::send(QEvent::Type type, QPoint place, Qt::MouseButton button,
                      Qt::MouseButtons down) {
  QMouseEvent event(type, place, view().mapToGlobal(place), button, down, Qt::NoModifier);
  QApplication::sendEvent(&view(), &event);
}

void RvizWindow::clickAt(int x, int y, Qt::MouseButton button) {
  send(QEvent::MouseButtonPress, {x, y}, button, button);
  send(QEvent::MouseButtonRelease, {x, y}, button, Qt::NoButton);
}

void RvizWindow::drag(QPoint from, QPoint to) {
  send(QEvent::MouseButtonPress, from, Qt::LeftButton, Qt::LeftButton);
  send(QEvent::MouseMove, to, Qt::NoButton, Qt::LeftButton);
  send(QEvent::MouseButtonRelease, to, Qt::LeftButton, Qt::NoButton);
}

void RvizWindow::moveMouse(int x, int y) { send(QEvent::MouseMove, {x, y}, Qt::NoButton, {}); }

void RvizWindow::takeMouseAway() {
  QEvent event(QEvent::Leave);
  QApplication::sendEvent(&view(), &event);
}

}  // namespace split_mapf::test
