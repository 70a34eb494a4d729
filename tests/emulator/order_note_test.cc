#include "emulator/order_note.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

namespace understudy::emulator {
namespace {

OrderNote Note(const Order& order) { return NoteOf(order, 1.5, "base", robot::StartPose::kLying); }

TEST(OrderNoteTest, SaysWhatWasOrdered) {
  const PushBody push{.body = "", .force = {0, -50, 0.125}, .seconds = 0.1};
  EXPECT_EQ(Describe(Note(push)), "push base by 0 -50 0.125 N for 0.1 s");
  EXPECT_EQ(DetailOf(Note(push)).dump(),
            R"({"body":"base","force":[0.0,-50.0,0.125],"seconds":0.1})");
  EXPECT_EQ(Note(push).time, 1.5);
  EXPECT_EQ(Describe(Note(ResetRobot{})), "reset to lying");
  EXPECT_EQ(DetailOf(Note(ResetRobot{robot::StartPose::kStanding})).dump(),
            R"({"pose":"standing"})");
  EXPECT_EQ(Describe(Note(DragBody{.body = "foot", .p_WT = {1, 2, 3}})), "drag foot to 1 2 3");
  EXPECT_EQ(Describe(Note(ReleaseDrag{})), "let go of all that is dragged");
  EXPECT_EQ(Describe(Note(ReleaseDrag{"foot"})), "let go of foot");
  EXPECT_EQ(Describe(Note(StepRun{5})), "5 steps");
  EXPECT_EQ(Describe(Note(LowerCrane{-0.25})), "crane raised by 0.25 m");
}

TEST(OrderNoteTest, IsNoneForWhatAStatusShows) {
  EXPECT_EQ(Note(PauseRun{}).kind, OrderKind::kNone);
  EXPECT_EQ(Note(HoldRemote{}).kind, OrderKind::kNone);
  OrderNotes notes;
  notes.Add(Note(PauseRun{}));
  EXPECT_EQ(notes.count, 0U);
}

TEST(OrderNoteTest, CutsNamesThatAreTooLong) {
  const OrderNote note = Note(ReleaseDrag{std::string(200, 'x')});
  EXPECT_EQ(std::string_view(note.what.data()), std::string(63, 'x'));
}

TEST(OrderNotesTest, KeepsTheNewest) {
  OrderNotes notes;
  for (int i = 0; i < 20; ++i) notes.Add(Note(StepRun{i}));
  EXPECT_EQ(notes.count, 20U);
  EXPECT_EQ(notes.oldest(), 12U);
  EXPECT_EQ(notes[19].amount, 19);
  EXPECT_EQ(notes[12].amount, 12);
}

}  // namespace
}  // namespace understudy::emulator
