// SPDX-License-Identifier: Apache-2.0
#include "app/update/refusal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orbwatch::app::update {
namespace {

using testing::HasSubstr;
using testing::Optional;

Offer newer() {
  return {.version = "1.10",
          .compatible = "orbwatch-arm64",
          .installed = "1.9",
          .device = "orbwatch-arm64"};
}

TEST(Refusal, ComparesNumbersOfVersions) {
  EXPECT_LT(compare_versions("1.9", "1.10"), 0);
  EXPECT_LT(compare_versions("0.1.0", "0.1.0.1"), 0);
  EXPECT_GT(compare_versions("2", "1.99"), 0);
  EXPECT_EQ(compare_versions("1.2.3", "1.2.3"), 0);
  EXPECT_LT(compare_versions("2.0", "2.01"), 0);
  EXPECT_LT(compare_versions("26.1", "26.02"), 0);
  EXPECT_LT(compare_versions("1.09", "1.10"), 0);
  EXPECT_GT(compare_versions("1.0", "1"), 0);
  EXPECT_EQ(compare_versions("2.01", "2.1"), 0);
}

TEST(Refusal, TakesANewerVersion) { EXPECT_EQ(refusal_of(newer()), std::nullopt); }

TEST(Refusal, TakesNoOlderVersionAndNotTheSame) {
  Offer offer = newer();
  offer.installed = "1.11";
  EXPECT_THAT(refusal_of(offer), Optional(HasSubstr("1.10, is older than the running one, 1.11")));
  offer.installed = "1.10";
  EXPECT_THAT(refusal_of(offer), Optional(HasSubstr("1.10, runs already")));
}

TEST(Refusal, TakesNothingForOtherDevices) {
  Offer offer = newer();
  offer.compatible = "orbwatch-amd64";
  EXPECT_THAT(refusal_of(offer), Optional(HasSubstr("orbwatch-amd64, and this one is")));
}

TEST(Refusal, TriesNoVersionAgainThatItReturnedFrom) {
  Offer offer = newer();
  offer.returned_from = "1.10";
  EXPECT_THAT(refusal_of(offer), Optional(HasSubstr("has tried version 1.10")));
  offer.returned_from = "1.9.5";
  EXPECT_EQ(refusal_of(offer), std::nullopt);
}

TEST(Refusal, NamesTheSignatureOrTheFile) {
  EXPECT_THAT(refusal_of_bundle("signature verification failed: Verify error: self-signed"),
              HasSubstr("not signed by the key of this device (RAUC: signature"));
  EXPECT_THAT(refusal_of_bundle("Signature size exceeds bundle size"),
              HasSubstr("incomplete or not an update"));
}

}  // namespace
}  // namespace orbwatch::app::update
