// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/access/sha256.h"

#include <gtest/gtest.h>

namespace orbwatch::app::web::tests {
namespace {

constexpr const char* kOfNone = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";
/// FIPS 180-2, B.1: the bytes "abc".
constexpr const char* kOfAbc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";

TEST(Sha256, IsThatOfAllPartsTogether) {
  Sha256 hash;
  EXPECT_EQ(hash.digits(), kOfNone);
  hash.add("a");
  EXPECT_NE(hash.digits(), kOfAbc);
  hash.add("");
  hash.add("bc");
  EXPECT_EQ(hash.digits(), kOfAbc);
  EXPECT_EQ(hash.digits(), kOfAbc) << "asking ends nothing";
  hash.restart();
  EXPECT_EQ(hash.digits(), kOfNone);
  hash.add("abc");
  EXPECT_EQ(hash.digits(), kOfAbc);
}

}  // namespace
}  // namespace orbwatch::app::web::tests
