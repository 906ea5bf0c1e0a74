#include "ros/convert/text_limits.h"

#include <gtest/gtest.h>

namespace split_mapf {
namespace {

TEST(TextLimits, OfAName) {
  EXPECT_EQ(faultOfName(std::string(kMostNameBytes, 'a')), "");
  EXPECT_EQ(faultOfName(std::string(kMostNameBytes + 1, 'a')),
            "has 257 bytes; at most 256 are possible");
}

TEST(TextLimits, OfTheIdOfARobotThatIsToDrive) {
  EXPECT_EQ(faultOfRobotId("r\xc3\xbc"), "");
  EXPECT_EQ(faultOfRobotId(""), "is empty");
  EXPECT_EQ(faultOfRobotId("r\xff"), "is no UTF-8");
  EXPECT_NE(faultOfRobotId(std::string(kMostNameBytes + 1, 'a')), "");
}

}  // namespace
}  // namespace split_mapf
