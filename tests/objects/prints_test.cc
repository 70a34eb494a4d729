#include "objects/prints.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "objects/april_tags.h"

namespace understudy::objects {
namespace {

using testing::ElementsAre;

std::vector<std::string> Rows(const CellGrid& grid) {
  std::vector<std::string> rows;
  for (const std::vector<bool>& row : grid) {
    std::string& text = rows.emplace_back();
    for (const bool black : row) text += black ? '#' : '.';
  }
  return rows;
}

bool IsBlack(const std::vector<Print>& prints, double y, double z) {
  return std::ranges::any_of(prints, [&](const Print& print) {
    return std::abs(y - print.at[0]) < print.half[0] && std::abs(z - print.at[1]) < print.half[1];
  });
}

// As the pictures of AprilRobotics/apriltag-imgs have them.
TEST(AprilTagsTest, LookAsThePicturesOfTheirMakers) {
  EXPECT_THAT(Rows(AprilTag(0)), ElementsAre("########",  //
                                             "#..#.#.#",  //
                                             "##...#.#",  //
                                             "##..####",  //
                                             "#.#.####",  //
                                             "##.#..##",  //
                                             "####.###",  //
                                             "########"));
  EXPECT_THAT(Rows(AprilTag(23)), ElementsAre("########",  //
                                              "#.##...#",  //
                                              "#..##.##",  //
                                              "####...#",  //
                                              "###..###",  //
                                              "###.#..#",  //
                                              "##.#...#",  //
                                              "########"));
}

// The words of the family differ from each other, however they are turned, by 11 bits at least.
TEST(AprilTagsTest, DifferFromEachOtherByElevenCells) {
  const auto turned = [](const CellGrid& grid) {
    CellGrid other = grid;
    for (std::size_t row = 0; row < 8; ++row) {
      for (std::size_t column = 0; column < 8; ++column) other[row][column] = grid[7 - column][row];
    }
    return other;
  };
  const auto word = [](const CellGrid& grid) {
    std::uint64_t bits = 0;
    for (const std::vector<bool>& row : grid) {
      for (const bool black : row) bits = 2 * bits + (black ? 1 : 0);
    }
    return bits;
  };
  std::vector<std::uint64_t> seen;
  for (int id = 0; id < kAprilTags; ++id) {
    CellGrid grid = AprilTag(id);
    std::vector<std::uint64_t> own;
    for (int turn = 0; turn < 4; ++turn) {
      const std::uint64_t bits = word(grid);
      for (const std::uint64_t other : seen) ASSERT_GE(std::popcount(bits ^ other), 11) << id;
      own.push_back(bits);
      grid = turned(grid);
    }
    seen.insert(seen.end(), own.begin(), own.end());
  }
}

TEST(PrintsTest, CoverTheBlackCellsOfATagAndNoOthers) {
  const ObjectSpec tag{.kind = "tag", .id = 23};
  const CellGrid grid = AprilTag(23);
  const std::vector<Print> prints = PrintsOf(tag);
  for (int row = -1; row < 9; ++row) {
    for (int column = -1; column < 9; ++column) {
      const bool within = row >= 0 && row < 8 && column >= 0 && column < 8;
      const bool black =
          within && grid[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)];
      // 2 cm each, the first row at the top of 20 cm, the first column to the left.
      for (const double y : {0.001, 0.019}) {
        for (const double z : {0.001, 0.019}) {
          EXPECT_EQ(IsBlack(prints, -0.08 + 0.02 * column + y, 0.18 - 0.02 * row - z), black)
              << row << ", " << column;
        }
      }
    }
  }
}

TEST(PrintsTest, CoverEverySecondSquareOfACheckerboard) {
  const std::vector<Print> prints = PrintsOf({.kind = "checkerboard"});
  for (int row = -1; row < 8; ++row) {
    for (int column = -1; column < 10; ++column) {
      const bool within = row >= 0 && row < 7 && column >= 0 && column < 9;
      EXPECT_EQ(IsBlack(prints, -0.135 + 0.03 * (column + 0.5), 0.225 - 0.03 * (row + 0.5)),
                within && (row + column) % 2 == 0)
          << row << ", " << column;
    }
  }
}

// Two that only touch would let a row of white pixels through.
TEST(PrintsTest, LeaveNoSeamBetweenBlackCells) {
  const std::vector<Print> prints = PrintsOf({.kind = "tag"});
  for (int i = 1; i < 8; ++i) {
    const double seam = -0.08 + 0.02 * i;
    EXPECT_TRUE(IsBlack(prints, seam, 0.175)) << "of the first row";
    EXPECT_TRUE(IsBlack(prints, -0.075, 0.1 + seam)) << "of the first column";
  }
}

TEST(PrintsTest, AreNotOnOtherObjects) { EXPECT_TRUE(PrintsOf({.kind = "crate"}).empty()); }

}  // namespace
}  // namespace understudy::objects
