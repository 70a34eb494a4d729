#include "robot/pads.h"

#include <array>
#include <string>
#include <vector>

#include <gmock/gmock.h>

namespace understudy::robot {
namespace {

using testing::ElementsAre;

RobotSpec TwoHands() {
  RobotSpec spec;
  spec.hands = {{.name = "a",
                 .pads = {{.site = "left_tip_touch", .rows = 1, .columns = 2},
                          {.site = "", .rows = 1, .columns = 1}}},
                {.name = "b", .pads = {{.site = "skin", .rows = 2, .columns = 1}}}};
  return spec;
}

TEST(PadsTest, AreNamedByTheirSites) {
  EXPECT_THAT(PadNames(TwoHands()), ElementsAre("left_tip", "", "skin"));
}

TEST(PadsTest, FeelWhatTheirStrongestCellFeels) {
  const std::array<float, 5> cells{1, 3, 0, 2, 0.5F};
  ASSERT_EQ(CellsOf(TwoHands()), cells.size());
  std::array<double, 3> pads{};
  StrongestCells(TwoHands(), cells, pads);
  EXPECT_THAT(pads, ElementsAre(3, 0, 2));
}

}  // namespace
}  // namespace understudy::robot
