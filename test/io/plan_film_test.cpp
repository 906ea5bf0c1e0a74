#include "split_mapf/io/plan_film.h"

#include <gtest/gtest.h>

#include <cstdlib>

#include "io/palette.h"
#include "split_mapf/core/error.h"

namespace split_mapf {
namespace {

constexpr std::uint32_t kCellPx = 50;

const Grid corridor(4, 1, {true, true, true, true});

PictureOptions cells() {
  PictureOptions options;
  options.cell_px = kCellPx;
  return options;
}

/// The pixel at this place of the map [cells].
Colour lookAt(const Picture& picture, const Grid& grid, double x, double y) {
  const std::uint32_t margin = (picture.width_px - grid.width() * kCellPx) / 2;
  return picture.at(margin + static_cast<std::uint32_t>(x * kCellPx),
                    margin + static_cast<std::uint32_t>(y * kCellPx));
}

TEST(PlanFilm, ShowsRobotsBetweenTheirCells) {
  const PlanFilm film(corridor, {{{0, 0}, {1, 0}, {1, 0}, {2, 0}}}, cells());
  EXPECT_EQ(film.lastStep(), 3);
  EXPECT_EQ(lookAt(film.at(0), corridor, 0.5, 0.5), robotColour(0));
  const Picture half_way = film.at(0.5);
  EXPECT_EQ(lookAt(half_way, corridor, 1.0, 0.5), robotColour(0));
  EXPECT_EQ(lookAt(half_way, corridor, 0.5, 0.5), kFreeColour);
  EXPECT_EQ(lookAt(film.at(1.5), corridor, 1.5, 0.5), robotColour(0));  // it waits
}

TEST(PlanFilm, RobotsStayBeforeTheStartAndBehindTheEnd) {
  const PlanFilm film(corridor, {{{0, 0}, {1, 0}}, {{3, 0}}}, cells());
  EXPECT_EQ(lookAt(film.at(-1), corridor, 0.5, 0.5), robotColour(0));
  EXPECT_EQ(lookAt(film.at(1e9), corridor, 1.5, 0.5), robotColour(0));
  EXPECT_EQ(lookAt(film.at(1e9), corridor, 3.5, 0.5), robotColour(1));
}

TEST(PlanFilm, AGoalIsARingUntilItsRobotComes) {
  const PlanFilm film(corridor, {{{0, 0}, {1, 0}, {2, 0}}}, cells());
  EXPECT_FALSE(lookAt(film.at(0), corridor, 2.5, 0.5) == robotColour(0));
  EXPECT_EQ(lookAt(film.at(0), corridor, 2.5 - 0.27, 0.5), robotColour(0));
  EXPECT_EQ(lookAt(film.at(2), corridor, 2.5, 0.5), robotColour(0));
}

TEST(PlanFilm, RefusesPathsThatLeaveTheMap) {
  EXPECT_THROW(PlanFilm(corridor, {{{0, 0}, {0, 1}}}), InputError);
  EXPECT_THROW(PlanFilm(corridor, CellPaths{{}}), InputError);
}

TEST(DrawHeat, IsDarkerWhereMoreRobotsStand) {
  const Picture picture =
      drawHeat(corridor, {{{0, 0}, {1, 0}, {1, 0}, {1, 0}}, {{2, 0}, {1, 0}}}, cells());
  const Colour once = lookAt(picture, corridor, 0.5, 0.5);
  const Colour often = lookAt(picture, corridor, 1.5, 0.5);
  EXPECT_EQ(lookAt(picture, corridor, 2.5, 0.5), once);
  EXPECT_EQ(lookAt(picture, corridor, 3.5, 0.5), kFreeColour);
  EXPECT_EQ(once, heatColour(0));
  EXPECT_EQ(often, heatColour(1));
  EXPECT_LT(often.green, once.green);
}

}  // namespace
}  // namespace split_mapf
