// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/participant/entity.h"

#include <gtest/gtest.h>

namespace orbwatch::app::dds {
namespace {

TEST(EntityTest, IsDeletedWithItsOwnerAndMoves) {
  Entity first(dds_create_waitset(DDS_CYCLONEDDS_HANDLE));
  const dds_entity_t handle = first.get();
  ASSERT_GT(handle, 0);
  {
    const Entity second = std::move(first);
    EXPECT_FALSE(first);  // moved-from, on purpose
    EXPECT_EQ(second.get(), handle);
    EXPECT_EQ(dds_waitset_set_trigger(handle, true), DDS_RETCODE_OK);
  }
  EXPECT_LT(dds_waitset_set_trigger(handle, true), 0) << "the wait set must be gone";
}

TEST(EntityTest, FailedHandlesAreNone) {
  const Entity failed(DDS_RETCODE_OUT_OF_RESOURCES);
  EXPECT_FALSE(failed);
}

TEST(EntityTest, ErrorsSayWhatAndWhy) {
  EXPECT_EQ(dds_error("writer", DDS_RETCODE_OUT_OF_RESOURCES).message,
            "DDS writer: Out Of Resources");
}

TEST(EntityTest, ErrorsOfAccessControlAreKnownWithFurtherText) {
  Error error = dds_error("reader", DDS_RETCODE_NOT_ALLOWED_BY_SECURITY);
  EXPECT_TRUE(is_refused_by_security(error));
  error.message += " (rt/orbwatch/machine_state)";
  EXPECT_TRUE(is_refused_by_security(error));
  for (const dds_return_t other : {DDS_RETCODE_ERROR, DDS_RETCODE_OUT_OF_RESOURCES,
                                   DDS_RETCODE_BAD_PARAMETER, DDS_RETCODE_NOT_ENABLED}) {
    EXPECT_FALSE(is_refused_by_security(dds_error("reader", other))) << other;
  }
}

}  // namespace
}  // namespace orbwatch::app::dds
