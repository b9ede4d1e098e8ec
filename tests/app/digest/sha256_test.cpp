// SPDX-License-Identifier: Apache-2.0
#include "app/digest/sha256.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace orbwatch::app::tests {
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

TEST(Sha256, OfBytesAndOfAFileIsTheSame) {
  EXPECT_EQ(sha256(""), kOfNone);
  EXPECT_EQ(sha256("abc"), kOfAbc);
  const orbwatch::tests::TemporaryFolder folder;
  const auto file = folder.path() / "long";
  const std::string bytes(200'001, 'x');  // more than one part of 64 KiB
  std::ofstream(file, std::ios::binary) << bytes;
  EXPECT_EQ(sha256_of(file), sha256(bytes));
}

TEST(Sha256, AFileThatCannotBeReadIsNamed) {
  const orbwatch::tests::TemporaryFolder folder;
  const auto missing = folder.path() / "missing";
  const auto hash = sha256_of(missing);
  ASSERT_FALSE(hash);
  EXPECT_EQ(hash.error().message, missing.string() + ": cannot be read");
}

}  // namespace
}  // namespace orbwatch::app::tests
