#pragma once

#include <rviz/ogre_helpers/ogre_vector.h>

namespace rviz {
class VisualizationManager;
}

namespace split_mapf {

/// Shows a rectangle of the ground that has this middle in the fixed frame and these sides [m]:
/// from above, or where the user orbits from that side. Any other kind of view gives way to one
/// from above.
void fitView(rviz::VisualizationManager& manager, const Ogre::Vector3& middle, float width,
             float height);

/// Moves the view's middle to a point of the fixed frame, for the kinds of view that can.
void lookAt(rviz::VisualizationManager& manager, const Ogre::Vector3& point);

}  // namespace split_mapf
