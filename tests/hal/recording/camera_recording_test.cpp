// SPDX-License-Identifier: Apache-2.0
#include "hal/recording/camera_recording.h"

#include <gtest/gtest.h>

#include <memory>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/hal/recording/picture_file.h"
#include "tests/hal/recording/random_picture.h"
#include "tests/support/temporary_folder.h"

/// Pictures written by the writer of recordings, as read back.
namespace orbwatch::hal::recording {
namespace {

using tests::CameraTopics;
using tests::contains;
using tests::PictureFile;
using tests::RandomPicture;
using tests::samples_at;
using tests::TemporaryFolder;

constexpr std::uint64_t kBegin = 1'700'000'000'000'000'000;
constexpr std::uint64_t kPeriod = 33'333'333;

CameraRecording opened(const std::filesystem::path& file, std::string_view camera) {
  auto recording = CameraRecording::open(file, camera);
  if (!recording) throw std::runtime_error(recording.error().message);
  return std::move(*recording);
}

std::string refusal(const std::filesystem::path& file, std::string_view camera = "north") {
  const auto recording = CameraRecording::open(file, camera);
  return recording ? "accepted" : recording.error().message;
}

TEST(CameraRecording, EveryPixelAndStampReturns) {
  constexpr int kPictures = 12;
  std::mt19937 random(360);
  for (const PixelFormatInfo& facts : kPixelFormats) {
    const TemporaryFolder folder;
    const auto sides = tests::random_sides(random, facts.format);
    std::vector<RandomPicture> pictures;
    std::vector<PictureRegion> regions;
    {
      PictureFile file(folder / "event.mcap");
      const StreamFormat format{facts.format, {}, sides.width, sides.height, 30, 0.04, 1};
      CameraTopics north(file, "north", format), south(file, "south", format);
      for (std::uint32_t k = 0; k < kPictures; ++k) {
        pictures.emplace_back(random, facts.format, sides.width, sides.height, 6);
        regions.push_back(tests::random_region(random, facts.format, sides.width, sides.height));
        const std::uint64_t time = kBegin + k * kPeriod;
        north.write(pictures.back().picture, regions.back(), time, time, 7 + k);
        if (k % 2 == 0) south.write(pictures.back().picture, regions.back(), time, time + 500, k);
        if (k % 5 == 4) file.flush();
      }
      file.finish();
    }
    CameraRecording north = opened(folder / "event.mcap", "north");
    const CameraIndex& index = north.index();
    EXPECT_EQ(index.format.format, facts.format);
    EXPECT_EQ(index.format.width, sides.width);
    EXPECT_EQ(index.format.height, sides.height);
    EXPECT_EQ(index.format.kelvin_per_count, 0.04);
    EXPECT_EQ(index.time.begin, kBegin);
    EXPECT_EQ(index.time.period, std::chrono::nanoseconds(kPeriod));
    ASSERT_EQ(index.exposures.size(), kPictures);
    RandomPicture target(random, facts.format, sides.width, sides.height, 2);
    // Also backwards, and the same one twice.
    for (const std::size_t k : {0U, 1U, 2U, 3U, 4U, 5U, 11U, 11U, 2U, 8U}) {
      const auto& exposure = index.exposures[k];
      EXPECT_EQ(exposure.start, kBegin + k * kPeriod);
      EXPECT_EQ(exposure.set_time, exposure.start);
      EXPECT_EQ(exposure.sequence, 7 + k);
      const auto status = north.read(k, target.picture);
      ASSERT_TRUE(status) << status.error().message;
      EXPECT_EQ(*status, FrameStatus::Intact);
      RandomPicture black(random, facts.format, sides.width, sides.height, 0);
      blacken(black.picture);
      for (int y = 0; y < sides.height; ++y) {
        for (int x = 0; x < sides.width; ++x) {
          const Picture& expected =
              contains(regions[k], x, y) ? pictures[k].picture : black.picture;
          ASSERT_EQ(samples_at(target.picture, x, y), samples_at(expected, x, y))
              << facts.name << ", picture " << k << " at " << x << "," << y;
        }
      }
    }
    EXPECT_EQ(opened(folder / "event.mcap", "south").index().exposures.size(), kPictures / 2);
  }
}

TEST(CameraRecording, AnUnfinishedFileIsRead) {
  std::mt19937 random(361);
  const TemporaryFolder folder;
  const RandomPicture picture(random, PixelFormat::Y16, 8, 6, 0);
  PictureFile file(folder / "event.mcap");
  CameraTopics north(file, "north", {PixelFormat::Y16, {}, 8, 6});
  north.write(picture.picture, {2, 2, 4, 3}, kBegin, kBegin, 0);
  file.flush();
  EXPECT_EQ(opened(folder / "event.mcap", "north").index().exposures.size(), 1U);
}

TEST(CameraRecording, IsOpenedByAKnownIndexUntilTheFileChanges) {
  std::mt19937 random(370);
  const TemporaryFolder folder;
  const RandomPicture picture(random, PixelFormat::Grey, 8, 6, 0);
  for (const std::uint32_t count : {2U, 1U}) {
    PictureFile file(folder / (std::to_string(count) + ".mcap"));
    CameraTopics north(file, "north", {PixelFormat::Grey, {}, 8, 6});
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint64_t time = kBegin + k * kPeriod;
      north.write(picture.picture, {2, 2, 4, 3}, time, time, k);
      file.flush();
    }
    file.finish();
  }
  const auto index =
      std::make_shared<const CameraIndex>(opened(folder / "2.mcap", "north").index());
  auto same = CameraRecording::open(folder / "2.mcap", index);
  ASSERT_TRUE(same) << same.error().message;
  EXPECT_TRUE(same->part(1));
  auto changed = CameraRecording::open(folder / "1.mcap", index);
  ASSERT_TRUE(changed) << changed.error().message;
  EXPECT_TRUE(changed->part(0));
  const auto refused = changed->part(1);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("image_raw, picture 1: the recording has changed"),
            std::string::npos)
      << refused.error().message;
}

TEST(CameraRecording, IsOpenedByAKnownIndexOnlyIfItIsFinished) {
  std::mt19937 random(371);
  const TemporaryFolder folder;
  const RandomPicture picture(random, PixelFormat::Grey, 8, 6, 0);
  PictureFile file(folder / "event.mcap");
  CameraTopics north(file, "north", {PixelFormat::Grey, {}, 8, 6});
  north.write(picture.picture, {2, 2, 4, 3}, kBegin, kBegin, 0);
  file.flush();
  const auto index =
      std::make_shared<const CameraIndex>(opened(folder / "event.mcap", "north").index());
  const auto refused = CameraRecording::open(folder / "event.mcap", index);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("its summary is missing"), std::string::npos)
      << refused.error().message;
  file.finish();
  EXPECT_TRUE(CameraRecording::open(folder / "event.mcap", index));
}

TEST(CameraRecording, ExposuresHaveTheTriggerOfTheirSet) {
  std::mt19937 random(362);
  const TemporaryFolder folder;
  const RandomPicture picture(random, PixelFormat::Grey, 8, 6, 0);
  PictureFile file(folder / "event.mcap");
  CameraTopics north(file, "north", {PixelFormat::Grey, {}, 8, 6});
  const auto states = file.add("/orbwatch/process_state", SetNumbers::kType);
  for (std::uint32_t k = 0; k < 4; ++k) {
    const std::uint64_t time = kBegin + k * kPeriod;
    north.write(picture.picture, {0, 0, 8, 6}, time, time, k);
    file.write(states, time, k, SetNumbers{header_at(time, ""), k + 1, k == 0 ? 0U : 40 + k});
  }
  file.finish();
  const CameraRecording recording = opened(folder / "event.mcap", "north");
  const auto& exposures = recording.index().exposures;
  EXPECT_EQ(exposures[0].trigger, std::nullopt);
  EXPECT_EQ(exposures[1].trigger, 41U);
  EXPECT_EQ(exposures[3].trigger, 43U);
  EXPECT_EQ(recording.index().triggers, 3U);
}

/// Writes one JPEG picture of a region.
void write_jpeg(const std::filesystem::path& path, const cv::Mat& part, PixelFormat format,
                std::size_t bytes = static_cast<std::size_t>(-1)) {
  std::vector<unsigned char> jpeg;
  ASSERT_TRUE(cv::imencode(".jpg", part, jpeg, {cv::IMWRITE_JPEG_QUALITY, 95}));
  if (bytes < jpeg.size()) jpeg.resize(bytes);
  PictureFile file(path);
  const auto info = file.add(camera_info_topic("orbwatch", "north"), CameraInfo::kType);
  const auto pictures = file.add(compressed_topic("orbwatch", "north"), CompressedImage::kType,
                                 metadata_of({format, {}, 64, 48}));
  const Header header = header_at(kBegin, "north");
  file.write(info, kBegin, 0, camera_info_of({64, 48, {16, 8, part.cols, part.rows}}, header));
  file.write(pictures, kBegin, 0,
             CompressedImage{header, std::string(kColourJpeg), std::as_bytes(std::span(jpeg))});
  file.finish();
}

TEST(CameraRecording, JpegIsDecodedToItsPlace) {
  const TemporaryFolder folder;
  const cv::Mat part(16, 32, CV_8UC3, cv::Scalar(30, 200, 90));  // B G R
  for (const auto& [stated, decoded] : {std::pair{PixelFormat::Rgb, PixelFormat::Rgb},
                                        std::pair{PixelFormat::Yuyv, PixelFormat::Nv12},
                                        std::pair{PixelFormat::Grey, PixelFormat::Grey}}) {
    const auto path = folder / (std::string(info(stated).name) + ".mcap");
    write_jpeg(path, part, stated);
    CameraRecording recording = opened(path, "north");
    EXPECT_EQ(recording.index().format.format, decoded);
    std::mt19937 random(363);
    RandomPicture whole(random, decoded, 64, 48, 0);
    const auto status = recording.read(0, whole.picture);
    ASSERT_TRUE(status) << status.error().message;
    // ITU-R BT.601 of full range.
    const double luma = 0.299 * 90 + 0.587 * 200 + 0.114 * 30;
    const double first = decoded == PixelFormat::Rgb ? 90 : luma;
    const auto inside = samples_at(whole.picture, 20, 12);
    EXPECT_NEAR(std::to_integer<int>(inside[0]), first, 3) << info(stated).name;
    const auto outside = samples_at(whole.picture, 12, 12);
    EXPECT_EQ(std::to_integer<int>(outside[0]), 0);
    EXPECT_EQ(recording.index().format.colour_space.range, ColourRange::Full);
  }
}

TEST(CameraRecording, DamagedJpegIsRefusedWhenItIsRead) {
  const TemporaryFolder folder;
  std::mt19937 random(364);
  cv::Mat part(16, 32, CV_8UC1);
  cv::randu(part, 0, 255);
  write_jpeg(folder / "event.mcap", part, PixelFormat::Grey, 450);
  CameraRecording recording = opened(folder / "event.mcap", "north");
  RandomPicture whole(random, PixelFormat::Grey, 64, 48, 0);
  const auto status = recording.read(0, whole.picture);
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("/orbwatch/north/image_raw/compressed, picture 0: JPEG: "),
            std::string::npos)
      << status.error().message;
}

/// A file of three pictures; the third is written by `write`.
template <class Write>
std::string refusal_of_third(const Write& write) {
  std::mt19937 random(365);
  const TemporaryFolder folder;
  const RandomPicture picture(random, PixelFormat::Nv12, 16, 12, 0);
  PictureFile file(folder / "event.mcap");
  CameraTopics north(file, "north", {PixelFormat::Nv12, {}, 16, 12});
  north.write(picture.picture, {0, 0, 16, 12}, kBegin, kBegin, 0);
  north.write(picture.picture, {4, 4, 8, 8}, kBegin + 10, kBegin + 10, 1);
  write(file, north, picture.picture);
  file.finish();
  std::string text = refusal(folder / "event.mcap");
  const std::string start = (folder / "event.mcap").string() + ": ";
  return text.starts_with(start) ? text.substr(start.size()) : text;
}

TEST(CameraRecording, WrongPicturesAreRefusedInASentence) {
  const std::string third = "/orbwatch/north/image_raw, picture 2: ";
  const PictureRegion whole{0, 0, 16, 12};
  std::mt19937 random(366);
  const auto at = [&](std::uint64_t set_time, std::uint64_t start) {
    return refusal_of_third([&](PictureFile&, CameraTopics& north, const Picture& picture) {
      north.write(picture, whole, set_time, start, 2);
    });
  };
  EXPECT_EQ(at(kBegin + 20, kBegin + 11), "accepted");
  EXPECT_EQ(at(kBegin + 20, kBegin + 10),
            third + "its stamp must be later than that of the picture before");
  EXPECT_EQ(at(kBegin + 9, kBegin + 20),
            "picture at 1700000000000000009 ns behind one at 1700000000000000010 ns; frame sets "
            "must not go backwards");
  EXPECT_EQ(at(kBegin + 20, kBegin + 10'000'000'021),
            third + "its stamp must be within 10 s of its log_time");
  EXPECT_EQ(at(kBegin + 864'000'000'000'001, kBegin + 864'000'000'000'001),
            "pictures of 864000 s; at most 240 hours are replayed");
  EXPECT_EQ(refusal_of_third([&](PictureFile&, CameraTopics& north, const Picture&) {
              const RandomPicture large(random, PixelFormat::Nv12, 18, 12, 0);
              north.write(large.picture, whole, kBegin + 20, kBegin + 20, 2);
            }),
            third + "camera_info has another size than that of the first picture");
  EXPECT_EQ(refusal_of_third([&](PictureFile&, CameraTopics& north, const Picture&) {
              const RandomPicture grey(random, PixelFormat::Grey, 16, 12, 0);
              north.write(grey.picture, whole, kBegin + 20, kBegin + 20, 2);
            }),
            third + "pixel format grey; the camera's first picture has nv12");
}

/// Writes a recording whose messages of a camera are these bytes.
void write_bytes(const std::filesystem::path& path, const mcap::Bytes& info,
                 const mcap::Bytes& picture) {
  auto writer = tests::required(mcap::Writer::create(path, {.chunk = std::size_t{64} << 10}));
  const auto add = [&](const std::string& topic, std::string_view type) {
    const auto schema = tests::required(writer.add_schema({0, std::string(type), "ros2msg", "#"}));
    return tests::required(writer.add_channel({0, schema, topic, "cdr", {}}));
  };
  const auto infos = add("/a/north/camera_info", CameraInfo::kType);
  const auto images = add("/a/north/image_raw", Image::kType);
  tests::required(writer.write({infos, 0, kBegin, kBegin}, info));
  tests::required(writer.write({images, 0, kBegin, kBegin}, picture));
  tests::required(writer.finish());
}

TEST(CameraRecording, DamagedMessagesAreReadOrRefusedInASentence) {
  std::mt19937 random(369);
  const TemporaryFolder folder;
  const RandomPicture source(random, PixelFormat::Yuyv, 8, 6, 0);
  const Header header = header_at(kBegin, "north");
  mcap::Bytes pixels, info, picture;
  mcap::encode_cdr(camera_info_of({12, 10, {2, 3, 8, 6}}, header), info);
  mcap::encode_cdr(image_of(source.picture, header, pixels), picture);
  std::size_t read = 0, refused = 0;
  for (int n = 0; n < 1000; ++n) {
    auto damaged_info = info, damaged_picture = picture;
    // Behind the pixels there is nothing to damage.
    auto& damaged = n % 2 == 0 ? damaged_info : damaged_picture;
    const auto most = static_cast<int>(std::min<std::size_t>(damaged.size(), 68));
    for (int k = tests::between(random, 1, 2); k > 0; --k) {
      damaged[static_cast<std::size_t>(tests::between(random, 4, most - 1))] =
          static_cast<std::byte>(tests::between(random, 0, 255));
    }
    if (n % 7 == 0) damaged.resize(static_cast<std::size_t>(tests::between(random, 0, most)));
    const auto path = folder / (std::to_string(n) + ".mcap");
    write_bytes(path, damaged_info, damaged_picture);
    auto recording = CameraRecording::open(path, "north");
    if (!recording) {
      EXPECT_EQ(recording.error().message.find('\n'), std::string::npos);
      ++refused;
      continue;
    }
    const StreamFormat& format = recording->index().format;
    ++read;
    if (format.width * format.height > 10'000) continue;  // takes the test's time
    const RandomPicture whole(random, format.format, format.width, format.height, 0);
    EXPECT_TRUE(recording->read(0, whole.picture));
  }
  EXPECT_GT(read, 50U);
  EXPECT_GT(refused, 50U);
}

TEST(CameraRecording, NamesTheCamerasThatItHas) {
  std::mt19937 random(367);
  const TemporaryFolder folder;
  const RandomPicture picture(random, PixelFormat::Y16, 8, 6, 0);
  PictureFile file(folder / "event.mcap");
  CameraTopics north(file, "north", {PixelFormat::Y16, {}, 8, 6});
  CameraTopics south(file, "south", {PixelFormat::Y16, {}, 8, 6});
  north.write(picture.picture, {0, 0, 8, 6}, kBegin, kBegin, 0);
  south.write(picture.picture, {0, 0, 8, 6}, kBegin, kBegin, 0);
  file.write(file.add("/other/south/image_raw", Image::kType), kBegin, 0, Image{});
  file.finish();
  const std::string start = (folder / "event.mcap").string() + ": ";
  EXPECT_EQ(refusal(folder / "event.mcap", "east"),
            start + "no pictures of camera east; it has pictures of north, south");
  EXPECT_EQ(refusal(folder / "event.mcap", "south"),
            start +
                "pictures of camera south in two channels, /orbwatch/south/image_raw and "
                "/other/south/image_raw; there must be one");
}

TEST(CameraRecording, AnotherPixelFormatInTheMetadataIsRefused) {
  std::mt19937 random(368);
  const TemporaryFolder folder;
  const RandomPicture picture(random, PixelFormat::Y16, 8, 6, 0);
  PictureFile file(folder / "event.mcap");
  CameraTopics north(file, "north", {PixelFormat::Rgb, {}, 8, 6});
  north.write(picture.picture, {0, 0, 8, 6}, kBegin, kBegin, 0);
  file.finish();
  EXPECT_NE(refusal(folder / "event.mcap")
                .find("metadata of the channel: pixel_format is rgb, but the picture is y16"),
            std::string::npos);
}

}  // namespace
}  // namespace orbwatch::hal::recording
