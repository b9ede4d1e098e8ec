// SPDX-License-Identifier: Apache-2.0
#include "app/watch/kept_zero.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>

#include "tests/support/temporary_folder.h"

namespace orbwatch::app {
namespace {

constexpr ZeroSubject kThermal{
    .alignment = 0xfeedbeef, .width = 40, .height = 30, .format = PixelFormat::Y12};

// Places in the file.
constexpr std::size_t kVersionAt = 8, kChecksumAt = 12, kCheckedAt = 16, kWidthAt = 24,
                      kPlaceAt = 32, kSigmaAt = 64, kPixelsAt = 72;

KeptZero some_zero() {
  cv::Mat luminance(kThermal.height, kThermal.width, CV_16U);
  cv::RNG(3).fill(luminance, cv::RNG::UNIFORM, 0, 4096);
  return {{{0.25, -0.5, 0.001, -0.002}, 0.01}, luminance};
}

template <class Value>
void put(std::string& file, std::size_t place, Value value) {
  std::memcpy(file.data() + place, &value, sizeof value);
}

/// Corrects the checksum, as an attacker would.
std::string sealed(std::string file) {
  const std::string checked = file.substr(kCheckedAt);
  put(file, kChecksumAt,
      static_cast<std::uint32_t>(
          crc32_z(0, reinterpret_cast<const Bytef*>(checked.data()), checked.size())));
  return file;
}

class KeptZeroTest : public testing::Test {
 protected:
  KeptZeroTest() {
    const auto kept = keep_zero(file_, kThermal, some_zero());
    EXPECT_TRUE(kept) << kept.error().message;
    std::ifstream in(file_, std::ios::binary);
    content_ = {std::istreambuf_iterator<char>(in), {}};
  }

  void expect_refused(const std::string& content, const std::string& why) {
    std::ofstream(file_, std::ios::binary) << content;
    const auto read = kept_zero(file_, kThermal);
    ASSERT_FALSE(read) << why;
    EXPECT_NE(read.error().message.find(file_.string()), std::string::npos);
    EXPECT_NE(read.error().message.find(why), std::string::npos) << read.error().message;
    EXPECT_EQ(read.error().message.find('\n'), std::string::npos);
  }

  orbwatch::tests::TemporaryFolder folder_;
  std::filesystem::path file_ = zero_file(folder_.path(), "thermal");
  std::string content_;
};

TEST_F(KeptZeroTest, IsReadAsItWasWritten) {
  const auto read = kept_zero(file_, kThermal);
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_TRUE(*read);
  const KeptZero written = some_zero();
  const auto& [zero, luminance] = **read;
  EXPECT_EQ(zero.place.u, written.zero.place.u);
  EXPECT_EQ(zero.place.v, written.zero.place.v);
  EXPECT_EQ(zero.place.growth, written.zero.place.growth);
  EXPECT_EQ(zero.place.roll, written.zero.place.roll);
  EXPECT_EQ(zero.sigma, written.zero.sigma);
  ASSERT_EQ(luminance.type(), CV_16U);
  EXPECT_EQ(cv::norm(luminance, written.luminance, cv::NORM_INF), 0);
}

TEST_F(KeptZeroTest, IsForItsOwnerOnly) {
  EXPECT_EQ(std::filesystem::status(file_).permissions(),
            std::filesystem::perms::owner_read | std::filesystem::perms::owner_write);
  EXPECT_EQ(folder_.files(), 1) << "no temporary file is left";
}

TEST_F(KeptZeroTest, IsNoneOfAnotherAlignment) {
  ZeroSubject other = kThermal;
  other.alignment += 1;
  const auto read = kept_zero(file_, other);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_FALSE(*read);
}

TEST_F(KeptZeroTest, IsNoneWithoutAFileOrAFolder) {
  EXPECT_FALSE(*kept_zero(zero_file(folder_.path(), "other"), kThermal));
  EXPECT_FALSE(*kept_zero(zero_file({}, "thermal"), kThermal));
  EXPECT_FALSE(keep_zero(zero_file({}, "thermal"), kThermal, some_zero()));
}

TEST_F(KeptZeroTest, RefusesPicturesOfAnotherSizeOrFormat) {
  ZeroSubject other = kThermal;
  other.width = 80;
  const auto read = kept_zero(file_, other);
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("40x30, the camera's are 80x30"), std::string::npos);
  other = kThermal;
  other.format = PixelFormat::Y16;
  EXPECT_FALSE(kept_zero(file_, other));
}

TEST_F(KeptZeroTest, RefusesEachDamage) {
  for (std::size_t n = 0; n < content_.size(); n += 7) {
    std::string damaged = content_;
    damaged[n] = static_cast<char>(damaged[n] ^ 0x10);
    EXPECT_FALSE(parsed_zero(damaged, kThermal)) << n;
    EXPECT_FALSE(parsed_zero(std::string_view(content_).substr(0, n), kThermal)) << n;
  }
  expect_refused(content_.substr(0, content_.size() - 1), "checksum");
  expect_refused("no zero", "too short");
}

TEST_F(KeptZeroTest, RefusesHostileContentWithARightChecksum) {
  const auto with = [&](std::size_t place, auto value) {
    std::string changed = content_;
    put(changed, place, value);
    return sealed(changed);
  };
  expect_refused(with(kVersionAt, std::uint32_t{2}), "version 2");
  expect_refused(with(kWidthAt, std::uint32_t{0xffffffff}), "4294967295x30");
  for (const double value : {std::numeric_limits<double>::quiet_NaN(),
                             std::numeric_limits<double>::infinity(), 1e300, -1e300}) {
    for (std::size_t n = 0; n < 4; ++n) {
      expect_refused(with(kPlaceAt + 8 * n, value), "impossible place");
    }
    expect_refused(with(kSigmaAt, value), "impossible place");
  }
  expect_refused(with(kPixelsAt, std::uint32_t{0}), "picture is damaged");
  expect_refused(sealed(content_.substr(0, content_.size() - 9)), "picture is damaged");
  expect_refused(sealed(content_.substr(0, kPixelsAt)), "picture is damaged");
}

/// Content that zlib would inflate to more than a picture.
TEST_F(KeptZeroTest, RefusesAPictureThatInflatesToMore) {
  const std::string zeros(std::size_t{1} << 20, '\0');
  uLongf size = compressBound(zeros.size());
  std::string deflated(size, '\0');
  ASSERT_EQ(compress(reinterpret_cast<Bytef*>(deflated.data()), &size,
                     reinterpret_cast<const Bytef*>(zeros.data()), zeros.size()),
            Z_OK);
  expect_refused(sealed(content_.substr(0, kPixelsAt) + deflated.substr(0, size)),
                 "picture is damaged");
  expect_refused(content_ + std::string(std::size_t{1} << 20, 'x'), "is larger than");
}

/// The fuzzer's search in small, the same each time: what is accepted is possible.
TEST_F(KeptZeroTest, AcceptsOnlyWhatIsPossibleOfRandomContent) {
  std::mt19937 random(11);
  int accepted = 0;
  for (int n = 0; n < 5000; ++n) {
    std::string changed = content_;
    for (unsigned k = random() % 3 + 1; k > 0; --k) {
      changed[kCheckedAt + random() % (changed.size() - kCheckedAt)] = static_cast<char>(random());
    }
    const auto read = parsed_zero(sealed(changed), kThermal);
    if (!read || !*read) continue;
    ++accepted;
    EXPECT_LT(std::abs((*read)->zero.place.u), kThermal.width);
    EXPECT_LT(std::abs((*read)->zero.place.v), kThermal.height);
    EXPECT_GE((*read)->zero.sigma, 0);
    EXPECT_EQ((*read)->luminance.size(), cv::Size(kThermal.width, kThermal.height));
  }
  EXPECT_GT(accepted, 0) << "low bits of the place may change";
}

}  // namespace
}  // namespace orbwatch::app
