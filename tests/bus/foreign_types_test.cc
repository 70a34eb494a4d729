#include "bus/foreign_types.h"

#include <gtest/gtest.h>

namespace understudy::bus {
namespace {

TEST(ForeignTypesTest, CycloneCallsWhatReadsThemByName) {
  EXPECT_TRUE(CycloneCalls("ddsi_tl_request_type"));
  EXPECT_TRUE(CycloneCalls("ddsi_tl_handle_reply"));
  EXPECT_TRUE(CycloneCalls("ddsi_type_ref_proxy"));
  EXPECT_TRUE(CycloneCalls("dds_stream_normalize"));
  EXPECT_TRUE(CycloneCalls("dds_stream_normalize_data"));
  EXPECT_FALSE(ReadsForeignTypes());
}

TEST(ForeignTypesTest, CycloneDoesNotCallWhatItHasNot) {
  EXPECT_FALSE(CycloneCalls("ddsi_tl_handle"));
  EXPECT_FALSE(CycloneCalls(""));
}

TEST(ForeignTypesTest, ThisProgramTakesThePlaceOfThem) { EXPECT_NO_THROW(RequireUnreadTypes()); }

}  // namespace
}  // namespace understudy::bus
