#include "emulator/request_notes.h"

#include "gtest/gtest.h"
#include "tests/support/requests.h"

namespace understudy::emulator {
namespace {

TEST(RequestNotesTest, KeepTheNewest) {
  RequestNotes notes;
  for (int i = 1; i <= 20; ++i) notes.Add({.time = 0, .request = test::RequestOf("step", i)});
  EXPECT_EQ(notes.count, 20U);
  EXPECT_EQ(notes.oldest(), 12U);
  EXPECT_EQ(notes[19].request.number("steps"), 20);
  EXPECT_EQ(notes[12].request.number("steps"), 13);
}

}  // namespace
}  // namespace understudy::emulator
