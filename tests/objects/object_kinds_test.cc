#include "objects/object_kinds.h"

#include <gmock/gmock.h>

namespace understudy::objects {
namespace {

using testing::ElementsAre;

TEST(ObjectKindsTest, NumbersTheNamesOfAKindFromTheSecondOn) {
  const std::vector<ObjectSpec> objects{{.kind = "cube"},
                                        {.kind = "cup"},
                                        {.kind = "cube"},
                                        {.kind = "cube", .name = "red"},
                                        {.kind = "cube"}};
  EXPECT_THAT(NamesOf(objects), ElementsAre("cube", "cup", "cube_2", "red", "cube_4"));
}

TEST(ObjectKindsTest, LeavesWhatIsFixedOutOfWhatMoves) {
  const std::vector<ObjectSpec> objects{{.kind = "table"}, {.kind = "cube"}, {.kind = "pedestal"}};
  EXPECT_THAT(MovingNamesOf(objects), ElementsAre("cube"));
}

TEST(ObjectKindsTest, CountsWhatWalksAmongWhatMoves) {
  const std::vector<ObjectSpec> objects{{.kind = "person"},
                                        {.kind = "person", .path = {{.to = {1, 0}}}}};
  EXPECT_THAT(MovingNamesOf(objects), ElementsAre("person_2"));
}

TEST(ObjectKindsTest, HasKindsWhoseUndersideIsAtTheBottomAndWhoseTopIsAsHighAsTheyAre) {
  for (const ObjectKind& kind : ObjectKinds()) {
    double bottom = 1e9, top = -1e9;
    for (const ObjectPart& part : kind.parts) {
      double half = part.size[2];
      if (part.shape == PartShape::kSphere) half = part.size[0];
      if (part.shape == PartShape::kCylinder) half = part.size[part.lies ? 0 : 1];
      if (part.shape == PartShape::kCapsule) half = part.size[0] + (part.lies ? 0 : part.size[1]);
      bottom = std::min(bottom, part.at[2] - half);
      top = std::max(top, part.at[2] + half);
    }
    EXPECT_NEAR(bottom, 0, 1e-9) << kind.name;
    EXPECT_NEAR(top, kind.height, 1e-9) << kind.name;
  }
}

}  // namespace
}  // namespace understudy::objects
