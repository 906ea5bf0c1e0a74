#include "split_mapf/io/picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "io/map_picture.h"
#include "io/palette.h"
#include "io/path_line.h"
#include "io/temporary_files.h"
#include "split_mapf/core/error.h"

namespace split_mapf {
namespace {

const Grid small_grid(4, 2, {true, true, true, true, true, false, true, true});

int brightnessOf(Colour c) { return (c.red + c.green + c.blue) / 3; }

bool alike(Colour a, Colour b, int tolerance) {
  return std::abs(a.red - b.red) <= tolerance && std::abs(a.green - b.green) <= tolerance &&
         std::abs(a.blue - b.blue) <= tolerance;
}

// Reads pixels of a picture by the cell they lie in.
struct Looker {
  const Picture& picture;
  std::uint32_t cell_px;
  std::uint32_t margin_px = (picture.width_px - small_grid.width() * cell_px) / 2;

  // The pixel at this place of the map [cells].
  Colour at(double x, double y) const {
    return picture.at(margin_px + static_cast<std::uint32_t>(x * cell_px),
                      margin_px + static_cast<std::uint32_t>(y * cell_px));
  }
};

TEST(PictureTest, ShowsFreeCellsLightAndObstaclesDark) {
  const Picture picture = drawPlan(small_grid, {});
  EXPECT_EQ(picture.pixels.size(), std::size_t{picture.width_px} * picture.height_px);
  const Looker look{picture, 64};
  EXPECT_GT(brightnessOf(look.at(0.5, 0.5)), 240);
  EXPECT_GT(brightnessOf(look.at(2.5, 1.5)), 240);
  EXPECT_LT(brightnessOf(look.at(1.5, 1.5)), 90);
  EXPECT_EQ(picture.at(0, 0), look.at(1.5, 1.5));  // beyond the map is no way either
}

TEST(PictureTest, DrawsPathStartAndGoal) {
  PictureOptions options;
  options.cell_px = 50;
  options.opacity = 1;
  const Picture picture = drawPlan(small_grid, {{{0, 0}, {1, 0}, {2, 0}, {2, 0}, {3, 0}}}, options);
  const Looker look{picture, 50};
  EXPECT_EQ(look.at(1.5, 0.5), robotColour(0));           // the way
  EXPECT_EQ(look.at(0.5, 0.5), (Colour{255, 255, 255}));  // the start is hollow
  EXPECT_EQ(look.at(0.23, 0.5), robotColour(0));
  EXPECT_EQ(look.at(3.5, 0.5), robotColour(0));     // the goal is filled
  EXPECT_GT(brightnessOf(look.at(1.5, 0.2)), 240);  // beside the way
}

TEST(PictureTest, ARobotThatStaysHasBothMarks) {
  PictureOptions options;
  options.cell_px = 60;
  const Picture picture = drawPlan(small_grid, {{{0, 1}, {0, 1}}}, options);
  const Looker look{picture, 60};
  EXPECT_EQ(look.at(0.5, 1.5), robotColour(0));
  EXPECT_EQ(look.at(0.5 - 0.3, 1.5), robotColour(0));
}

TEST(PictureTest, DrawsAnInstanceWithFaintLines) {
  PictureOptions options;
  options.cell_px = 50;
  const Picture picture = drawInstance(small_grid, {{0, 0}}, {{3, 0}}, options);
  const Looker look{picture, 50};
  EXPECT_EQ(look.at(3.5, 0.5), robotColour(0));
  EXPECT_EQ(look.at(0.5, 0.5), (Colour{255, 255, 255}));
  const Colour line = look.at(1.5, 0.5);
  EXPECT_GT(brightnessOf(line), brightnessOf(robotColour(0)) + 30);
  EXPECT_LT(brightnessOf(line), 240);
}

TEST(PictureTest, ChoosesTheScale) {
  const auto cell_of_square = [](std::uint32_t side) {
    const Grid grid(side, side, std::vector<bool>(std::size_t{side} * side, true));
    return drawPlan(grid, {}).width_px / side;
  };
  EXPECT_NEAR(drawPlan(Grid(32, 32, std::vector<bool>(1024, true)), {}).width_px, 1000, 30);
  EXPECT_EQ(cell_of_square(500), 4U);
  EXPECT_EQ(cell_of_square(1100), 2U);
}

TEST(PictureTest, DrawsGridLinesWhereTheyFit) {
  PictureOptions options;
  options.cell_px = 12;
  const auto count_light = [&] {
    const Picture picture = drawPlan(small_grid, {}, options);
    int light = 0;
    for (const Colour colour : picture.pixels) light += brightnessOf(colour) > 240 ? 1 : 0;
    return light;
  };
  const int cells = 7 * 12 * 12;
  EXPECT_EQ(count_light(), cells - 12 * (4 + 3) + 2);  // four upright, three level, two crossings
  options.grid_lines = false;
  EXPECT_EQ(count_light(), cells);
  options.grid_lines = true;
  options.cell_px = 11;
  EXPECT_EQ(count_light(), 7 * 11 * 11);
}

TEST(PictureTest, ManyRobotsHaveDistinctColours) {
  for (std::size_t i = 0; i < 12; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_FALSE(alike(robotColour(i), robotColour(j), 12)) << i << " and " << j;
    }
  }
}

TEST(PictureTest, CoursesLeaveOutWaitsAndRoundCorners) {
  const auto straight = courseOf({{0, 0}, {1, 0}, {1, 0}, {2, 0}, {3, 0}}, {0, 0});
  for (const Point point : straight) EXPECT_DOUBLE_EQ(point.y, 0.5);
  EXPECT_EQ(straight.size(), 4U);
  EXPECT_DOUBLE_EQ(straight.back().x, 3.5);
  const auto corner = courseOf({{0, 0}, {1, 0}, {1, 1}}, {0, 0});
  for (const Point point : corner) EXPECT_FALSE(point.x == 1.5 && point.y == 0.5);
  EXPECT_EQ(courseOf({{2, 1}, {2, 1}}, {0.1, 0.1}).size(), 1U);
  const auto there_and_back = courseOf({{0, 0}, {1, 0}, {0, 0}}, {0, 0});
  EXPECT_TRUE(std::any_of(there_and_back.begin(), there_and_back.end(),
                          [](Point point) { return point.x == 1.5; }));
}

class PictureFileTest : public test::FileTest {};

TEST_F(PictureFileTest, NamesRobotAndStepOutsideTheMap) {
  EXPECT_EQ(errorOf([] {
              drawPlan(small_grid, {{{0, 0}}, {{3, 0}, {4, 0}}});
            }),
            "robot 1: at step 1 the cell (4,0) is outside the 4x2 map that is to be drawn");
  EXPECT_EQ(errorOf([] { drawPlan(small_grid, {{}}); }),
            "robot 0: its path is empty, expected its start");
  EXPECT_EQ(errorOf([] {
              drawInstance(small_grid, {{0, 0}}, {{0, -1}});
            }),
            "robot 0: the goal (0,-1) is outside the 4x2 map that is to be drawn");
  EXPECT_EQ(errorOf([] {
              drawInstance(small_grid, {{0, 0}}, {});
            }),
            "1 start and 0 goals, expected as many");
}

TEST_F(PictureFileTest, NamesBadOptions) {
  PictureOptions options;
  options.cell_px = 257;
  EXPECT_EQ(errorOf([&] { drawPlan(small_grid, {}, options); }),
            "a cell of 257 pixels, expected 1 to 256");
  options = {};
  options.opacity = 1.5;
  EXPECT_THROW(drawPlan(small_grid, {}, options), OptionError);
  options = {};
  options.line_width_cells = -1;
  EXPECT_THROW(drawPlan(small_grid, {}, options), OptionError);
  options = {};
  options.cell_px = 256;
  const Grid large(1000, 1000, std::vector<bool>(1000000, true));
  EXPECT_EQ(errorOf([&] { drawPlan(large, {}, options); }),
            "a picture of a 1000x1000 grid with 256 pixels a cell is too large, expected at most "
            "134217728 pixels");
}

TEST_F(PictureFileTest, WritesAPngThatReadsBack) {
  const Picture picture = drawPlan(small_grid, {{{0, 0}, {1, 0}}});
  writePng(pathOf("a.png"), picture);
  const MapPicture again = parsePng("a.png", contentOf(pathOf("a.png")));
  ASSERT_EQ(again.width, picture.width_px);
  ASSERT_EQ(again.height, picture.height_px);
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const Colour c = picture.pixels[i];
    ASSERT_NEAR(again.brightness[i], (c.red + c.green + c.blue) / 3.0, 1e-3) << i;
  }
  EXPECT_EQ(errorOf([&] { writePng(pathOf("no/a.png"), picture); }),
            "cannot write no/a.png: No such file or directory");
}

TEST(PictureTest, ShowsRegionsBuffersAndStates) {
  Layout layout;
  layout.ownerships = {{0, 0, 1, 1, 0, 1, 1}, {0, 1, 1, 1, 0, 1, 1}};
  layout.phases.push_back({0, {4}});
  const CellPaths paths = {{{0, 0}, {1, 0}}};
  PictureOptions options;
  options.cell_px = 64;
  const Picture picture = drawPlan(small_grid, paths, layout, 0, options);
  const Looker look{picture, 64};
  const Colour left = look.at(0.1, 0.9);
  EXPECT_EQ(look.at(0.1, 1.1), left) << "both of region 0";
  EXPECT_NE(look.at(2.5, 0.5) == left, true) << "region 1";
  EXPECT_LT(brightnessOf(look.at(1.1, 0.9)), brightnessOf(left)) << "a buffer cell";
  EXPECT_TRUE(alike(look.at(0.5, 1.5), robotColour(0), 3)) << "the state";
  EXPECT_THROW(drawPlan(small_grid, paths, layout, 1), InputError) << "no such phase";
  layout.phases[0].states = {};
  EXPECT_THROW(drawPlan(small_grid, paths, layout, 0), InputError) << "no state for the robot";
  layout.phases[0].states = {4};
  layout.ownerships[1].pop_back();
  EXPECT_THROW(drawPlan(small_grid, paths, layout, 0), InputError) << "of another map";
}

}  // namespace
}  // namespace split_mapf
