#include "app/config/configuration.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace orbwatch::app {
namespace {

const std::string kValid = R"(
[[camera]]
name = "a"
back_end = "replay"
[camera.ball]
centre = [10, 10]
radius = 9
alpha = 340
[camera.replay]
source = "pictures"

[[view]]
name = "front"
width = 64
height = 48
[[view.source]]
camera = "a"
)";

Result<Configuration> parse(const std::string& text) {
  return parse_configuration(text, "site.toml", "/etc/orbwatch");
}

std::string replaced(const std::string& what, const std::string& with) {
  std::string text = kValid;
  text.replace(text.find(what), what.size(), with);
  return text;
}

TEST(Configuration, ReadsWhatIsThereAndDefaultsTheRest) {
  const auto c = parse(kValid);
  ASSERT_TRUE(c) << c.error().message;
  EXPECT_EQ(c->cameras[0].back_end, BackEnd::Replay);
  EXPECT_EQ(c->cameras[0].replay->source, "/etc/orbwatch/pictures") << "from the file's folder";
  EXPECT_EQ(c->cameras[0].ball.alpha, 340);
  EXPECT_EQ(c->views[0].kind, optics::ViewKind::Perspective);
  EXPECT_EQ(c->views[0].sources[0].weight, 1);
  EXPECT_EQ(c->modbus.port, 1502);
  EXPECT_FALSE(c->process);
}

struct Refusal {
  std::string name;
  std::string text;
  std::vector<std::string> says;  ///< what the message must contain
};

class ConfigurationRefusal : public testing::TestWithParam<Refusal> {};

TEST_P(ConfigurationRefusal, SaysFileLineKeyAndWhatIsAllowed) {
  const auto c = parse(GetParam().text);
  ASSERT_FALSE(c);
  const std::string& message = c.error().message;
  EXPECT_EQ(message.find('\n'), std::string::npos) << "one line: " << message;
  for (const auto& part : GetParam().says) {
    EXPECT_NE(message.find(part), std::string::npos) << message << "\nlacks: " << part;
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, ConfigurationRefusal,
    testing::Values(
        Refusal{"UnknownKey",
                replaced("radius = 9", "radius = 9\nradios = 3"),
                {"site.toml:8:", "camera.ball.radios", "radius"}},
        Refusal{"UnknownTable", "[bogus]\n" + kValid, {"site.toml:1:", "bogus", "modbus"}},
        Refusal{"WrongType",
                replaced("alpha = 340", "alpha = \"wide\""),
                {"site.toml:8:", "camera.ball.alpha", "above 180, at most 360"}},
        Refusal{"OutOfRange", replaced("alpha = 340", "alpha = 180"), {"site.toml:8:", "180"}},
        Refusal{"NotANumber", replaced("alpha = 340", "alpha = nan"), {"camera.ball.alpha", "nan"}},
        Refusal{"Infinite", replaced("[10, 10]", "[inf, 10]"), {"camera.ball.centre", "inf"}},
        Refusal{"FractionForWhole",
                replaced("width = 64", "width = 64.5"),
                {"view.width", "whole number, 1 to 16384"}},
        Refusal{"HugeSize", replaced("width = 64", "width = 16385"), {"view.width", "16384"}},
        Refusal{"ListTooShort", replaced("[10, 10]", "[10]"), {"camera.ball.centre", "2 numbers"}},
        Refusal{"Missing", replaced("radius = 9\n", ""), {"camera.ball.radius", "either"}},
        Refusal{"BothAlphaAndDistance",
                replaced("alpha = 340", "alpha = 340\ndistance = 9"),
                {"site.toml:8:", "either alpha or distance"}},
        Refusal{"UnknownWord",
                replaced("\"replay\"", "\"webcam\""),
                {"site.toml:4:", "back_end", "webcam", "simulated, replay, v4l2"}},
        Refusal{"BackEndWithoutTable",
                replaced("\"replay\"", "\"v4l2\""),
                {"back_end", "[camera.v4l2]"}},
        Refusal{"NoSuchCamera",
                replaced("camera = \"a\"", "camera = \"b\""),
                {"site.toml:16:", "\"b\"", "there are: a"}},
        Refusal{"BadName", replaced("\"front\"", "\"front door\""), {"view.name", "front door"}},
        Refusal{"ReservedName", replaced("\"front\"", "\"selected\""), {"view.name", "selected"}},
        Refusal{"NoCamera", "[console]\nenabled = true\n", {"camera", "1 to 4"}},
        Refusal{
            "WideView",
            kValid +
                "[[view]]\nname='w'\nh_fov=200\nwidth=9\nheight=9\n[[view.source]]\ncamera='a'\n",
            {"site.toml:18:", "h_fov", "below 180"}},
        Refusal{"TwiceTheSameView",
                kValid + "[[view]]\nname='front'\nwidth=9\nheight=9\n[[view.source]]\ncamera='a'\n",
                {"site.toml:18:", "twice"}},
        Refusal{"NoRotation",
                replaced("alpha = 340", "alpha = 340\nrotation_matrix = [1,0,0, 0,1,0, 0,0,-1]"),
                {"site.toml:9:", "rotation_matrix", "no rotation"}},
        Refusal{"RangeUpsideDown",
                replaced("camera = \"a\"", "camera = \"a\"\nrange = [9, 3]"),
                {"view.source.range", "below"}},
        Refusal{"ProcessWithoutView",
                kValid + "[process]\nview='x'\ncamera='a'\nthreshold=50\n",
                {"process.view", "\"x\"", "front"}},
        Refusal{
            "PortOutOfRange", kValid + "[modbus]\nport = 70000\n", {"site.toml:19:", "0 to 65535"}},
        Refusal{"NotToml", "[[camera\n", {"site.toml:1:", "not valid TOML"}},
        Refusal{"TableExpected", "camera = 3\n", {"site.toml:1:", "[[camera]]"}}),
    [](const auto& refusal) { return refusal.param.name; });

TEST(Configuration, MissingFileIsRefusedByName) {
  const auto c = load_configuration("/nonexistent/site.toml");
  ASSERT_FALSE(c);
  EXPECT_NE(c.error().message.find("/nonexistent/site.toml"), std::string::npos);
}

TEST(Configuration, ShippedFilesAreValid) {
  const std::filesystem::path folder =
      std::filesystem::path(ORBWATCH_SOURCE_DIR) / "platform/config";
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".toml") continue;
    const auto c = load_configuration(entry.path());
    EXPECT_TRUE(c) << c.error().message;
    ++files;
  }
  EXPECT_GE(files, 2);
}

TEST(Configuration, SurvivesEveryTruncation) {
  // Whatever is cut off: a value or one line that says why not, never a crash.
  std::ifstream in(std::filesystem::path(ORBWATCH_SOURCE_DIR) / "platform/config/demo.toml");
  std::stringstream whole;
  whole << in.rdbuf();
  const std::string text = whole.str();
  for (std::size_t length = 0; length < text.size(); length += 7) {
    const auto c = parse(text.substr(0, length));
    if (!c) {
      EXPECT_EQ(c.error().message.find('\n'), std::string::npos) << c.error().message;
    }
  }
}

TEST(ConfigurationManual, IsWhatIsCommitted) {
  std::ifstream in(std::filesystem::path(ORBWATCH_SOURCE_DIR) / "app/config/MANUAL.md");
  std::stringstream committed;
  committed << in.rdbuf();
  EXPECT_EQ(committed.str(), configuration_manual())
      << "regenerate it: orbwatch describe config > app/config/MANUAL.md";
}

}  // namespace
}  // namespace orbwatch::app
