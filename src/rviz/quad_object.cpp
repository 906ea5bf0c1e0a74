#include "rviz/quad_object.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <OgreAxisAlignedBox.h>
#include <OgreCamera.h>
#include <OgreHardwareBufferManager.h>
#include <OgreHardwarePixelBuffer.h>
#include <OgreMaterialManager.h>
#include <OgreNode.h>
#include <OgrePass.h>
#include <OgrePrerequisites.h>
#include <OgreResourceGroupManager.h>
#include <OgreTechnique.h>
#include <OgreTextureManager.h>

namespace split_mapf {
namespace {

constexpr const char* kPicture = "split_mapf/disc";
constexpr std::size_t kCornersAQuad = 4;
constexpr std::size_t kIndicesAQuad = 6;
constexpr std::uint32_t kPictureSide = 64;  // [pixels]
// [pixels] Dots up to here have no picture: that they are not round hardly shows, and a picture is
// a third of what they cost where GL is software.
constexpr float kMostPlainDot = 5;

/// White; opaque within the disc, and a pixel's width of shade at its edge.
void providePicture() {
  Ogre::TextureManager& textures = Ogre::TextureManager::getSingleton();
  const std::string& group = Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME;
  if (textures.resourceExists(kPicture)) return;
  const auto picture = textures.createManual(kPicture, group, Ogre::TEX_TYPE_2D, kPictureSide,
                                             kPictureSide, Ogre::MIP_UNLIMITED, Ogre::PF_BYTE_RGBA,
                                             Ogre::TU_STATIC | Ogre::TU_AUTOMIPMAP);
  std::vector<std::uint8_t> pixels;
  const double middle = kPictureSide / 2.0;
  for (std::uint32_t y = 0; y < kPictureSide; ++y) {
    for (std::uint32_t x = 0; x < kPictureSide; ++x) {
      const double inside = middle - std::hypot(x + 0.5 - middle, y + 0.5 - middle);
      pixels.insert(pixels.end(), 3, 255);
      pixels.push_back(static_cast<std::uint8_t>(255 * std::clamp(inside, 0.0, 1.0)));
    }
  }
  picture->getBuffer()->blitFromMemory(
      Ogre::PixelBox(kPictureSide, kPictureSide, 1, Ogre::PF_BYTE_RGBA, pixels.data()));
}

void addPicture(Ogre::Pass& pass) {
  providePicture();
  Ogre::TextureUnitState* unit = pass.createTextureUnitState(kPicture);
  unit->setTextureAddressingMode(Ogre::TextureUnitState::TAM_CLAMP);
  // Of the pictures of several sizes the best one alone: mixing two costs most where GL is
  // software.
  unit->setTextureFiltering(Ogre::FO_LINEAR, Ogre::FO_LINEAR, Ogre::FO_POINT);
}

/// Each mesh has its own, as it has dots of its own size.
Ogre::MaterialPtr makeMaterial(bool pictured) {
  static std::uint64_t number = 0;
  const Ogre::MaterialPtr material = Ogre::MaterialManager::getSingleton().create(
      "split_mapf/" + std::to_string(number++),
      Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME);
  material->setReceiveShadows(false);
  Ogre::Pass* pass = material->getTechnique(0)->getPass(0);
  pass->setLightingEnabled(false);
  pass->setSceneBlending(Ogre::SBT_TRANSPARENT_ALPHA);
  // Layers lie in one plane, and their order is that in which they are drawn.
  pass->setDepthWriteEnabled(false);
  pass->setDepthBias(1);
  pass->setCullingMode(Ogre::CULL_NONE);
  if (pictured) addPicture(*pass);
  return material;
}

void declareCorners(Ogre::VertexDeclaration& declaration) {
  declaration.addElement(0, offsetof(QuadVertex, x), Ogre::VET_FLOAT3, Ogre::VES_POSITION);
  declaration.addElement(0, offsetof(QuadVertex, colour), Ogre::VET_COLOUR_ABGR, Ogre::VES_DIFFUSE);
  declaration.addElement(0, offsetof(QuadVertex, u), Ogre::VET_FLOAT2,
                         Ogre::VES_TEXTURE_COORDINATES);
}

std::vector<std::uint32_t> indicesOf(std::size_t quads) {
  std::vector<std::uint32_t> indices;
  indices.reserve(kIndicesAQuad * quads);
  for (std::uint32_t quad = 0; quad < quads; ++quad) {
    for (const std::uint32_t corner : {0U, 1U, 2U, 2U, 3U, 0U}) {
      indices.push_back(static_cast<std::uint32_t>(kCornersAQuad) * quad + corner);
    }
  }
  return indices;
}

bool isOpaque(const QuadMesh& mesh) {
  return std::all_of(mesh.corners().begin(), mesh.corners().end(),
                     [](const QuadVertex& corner) { return corner.colour >> 24U == 0xFFU; });
}

}  // namespace

QuadObject::QuadObject(bool discs) : plain_(makeMaterial(false)) {
  if (discs) pictured_ = makeMaterial(true);
  use(plain_);
  mRenderOp.operationType = Ogre::RenderOperation::OT_TRIANGLE_LIST;
  mRenderOp.useIndexes = true;
  mRenderOp.vertexData = OGRE_NEW Ogre::VertexData;
  mRenderOp.indexData = OGRE_NEW Ogre::IndexData;
  declareCorners(*mRenderOp.vertexData->vertexDeclaration);
  mRenderOp.vertexData->vertexCount = 0;
  mRenderOp.indexData->indexCount = 0;
  mBox.setNull();
}

QuadObject::~QuadObject() {
  OGRE_DELETE mRenderOp.vertexData;
  OGRE_DELETE mRenderOp.indexData;
  Ogre::MaterialManager::getSingleton().remove(plain_->getName());
  if (pictured_.get() != nullptr) {
    Ogre::MaterialManager::getSingleton().remove(pictured_->getName());
  }
}

void QuadObject::use(const Ogre::MaterialPtr& material) {
#if OGRE_VERSION < ((1 << 16) | (10 << 8))
  setMaterial(material->getName());
#else
  setMaterial(material);
#endif
}

void QuadObject::choose(const QuadMesh& mesh) {
  const bool dots = mesh.kind() == MeshKind::kDots;
  const bool round = pictured_.get() != nullptr && !(dots && mesh.dotSize() <= kMostPlainDot);
  const Ogre::MaterialPtr& material = round ? pictured_ : plain_;
  use(material);
  mRenderOp.useIndexes = mesh.kind() == MeshKind::kPieces;
  mRenderOp.operationType = dots ? Ogre::RenderOperation::OT_POINT_LIST
                            : mesh.kind() == MeshKind::kLines
                                ? Ogre::RenderOperation::OT_LINE_LIST
                                : Ogre::RenderOperation::OT_TRIANGLE_LIST;
  Ogre::Pass& pass = *material->getTechnique(0)->getPass(0);
  pass.setPointSize(dots ? mesh.dotSize() : 1);
  pass.setPointSpritesEnabled(dots && round);
  // What covers all below need not be mixed with it.
  pass.setSceneBlending(!round && isOpaque(mesh) ? Ogre::SBT_REPLACE : Ogre::SBT_TRANSPARENT_ALPHA);
}

void QuadObject::reserve(std::size_t corners) {
  if (corners <= capacity_) return;
  capacity_ = std::max(corners, 2 * capacity_);
  const std::size_t quads = capacity_ / kCornersAQuad;
  Ogre::HardwareBufferManager& buffers = Ogre::HardwareBufferManager::getSingleton();
  mRenderOp.vertexData->vertexBufferBinding->setBinding(
      0, buffers.createVertexBuffer(sizeof(QuadVertex), capacity_,
                                    Ogre::HardwareBuffer::HBU_DYNAMIC_WRITE_ONLY_DISCARDABLE));
  mRenderOp.indexData->indexBuffer =
      buffers.createIndexBuffer(Ogre::HardwareIndexBuffer::IT_32BIT, kIndicesAQuad * quads,
                                Ogre::HardwareBuffer::HBU_STATIC_WRITE_ONLY);
  const std::vector<std::uint32_t> indices = indicesOf(quads);
  mRenderOp.indexData->indexBuffer->writeData(0, sizeof(std::uint32_t) * indices.size(),
                                              indices.data(), true);
}

void QuadObject::show(const QuadMesh& mesh) {
  const std::vector<QuadVertex>& corners = mesh.corners();
  mRenderOp.vertexData->vertexStart = 0;
  mRenderOp.vertexData->vertexCount = corners.size();
  mRenderOp.indexData->indexStart = 0;
  mRenderOp.indexData->indexCount = corners.size() / kCornersAQuad * kIndicesAQuad;
  if (corners.empty()) return;
  choose(mesh);
  reserve(corners.size());
  mRenderOp.vertexData->vertexBufferBinding->getBuffer(0)->writeData(
      0, sizeof(QuadVertex) * corners.size(), corners.data(), true);
  Ogre::AxisAlignedBox box;
  Ogre::Vector3 least(corners[0].x, corners[0].y, corners[0].z);
  Ogre::Vector3 most = least;
  for (const QuadVertex& corner : corners) {
    least.makeFloor({corner.x, corner.y, corner.z});
    most.makeCeil({corner.x, corner.y, corner.z});
  }
  box.setExtents(least, most);
  setBoundingBox(box);
  if (getParentNode() != nullptr) getParentNode()->needUpdate();
}

void QuadObject::_updateRenderQueue(Ogre::RenderQueue* queue) {
  if (mRenderOp.vertexData->vertexCount > 0) SimpleRenderable::_updateRenderQueue(queue);
}

Ogre::Real QuadObject::getBoundingRadius() const {
  if (mBox.isNull()) return 0;
  return std::max(mBox.getMinimum().length(), mBox.getMaximum().length());
}

Ogre::Real QuadObject::getSquaredViewDepth(const Ogre::Camera* camera) const {
  return getParentNode()->getSquaredViewDepth(camera);
}

}  // namespace split_mapf
