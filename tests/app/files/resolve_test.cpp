// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "tests/app/files/machine_files.h"
#include "tests/app/files/refusal.h"

/// References from a configuration to recipes, and contradictions between recipes.
namespace orbwatch::app::files {
namespace {

/// Recipe that measures camera a in a view of its own, with further text.
std::string recipe(const std::string& view, const std::string& more = "",
                   const std::string& keys = "") {
  return "name = \"" + view + "\"\n" + keys + "[[view]]\nname = \"" + view +
         "\"\nmeasured = \"a\"\nwidth = 32\nheight = 24\n[[view.source]]\ncamera = \"a\"\n"
         "[[region]]\nname = \"all\"\nview = \"" +
         view + "\"\nhot_spot_threshold = 90\n" + more;
}

const std::string kExposure = "[[control]]\ncamera = \"a\"\nname = \"ExposureTime\"\nvalue = 800\n";

/// Configuration that names recipes in files beside it.
std::string with_recipes(const std::vector<std::string>& files, std::string text = kValid) {
  for (std::size_t i = 0; i < files.size(); ++i) {
    text +=
        "[[recipe]]\nnumber = " + std::to_string(10 * (i + 1)) + "\nfile = \"" + files[i] + "\"\n";
  }
  return text;
}

/// Fixture with the recipes that refusals name.
class ConfigurationWithRecipes : public ConfigurationFile {
 protected:
  ConfigurationWithRecipes() {
    write("one.toml", recipe("one"));
    write("two.toml", recipe("two"));
    write("again.toml", recipe("one"));
    write("display.toml", recipe("front"));
    write("selected.toml", recipe("selected"));
    write("exposure.toml", recipe("one", kExposure));
    write("longer.toml", recipe("two", replaced("800", "1600", kExposure)));
    write("twice.toml", recipe("one", kExposure + kExposure));
    write("nobody.toml", recipe("one", replaced("camera = \"a\"", "camera = \"b\"", kExposure)));
    write("source.toml",
          replaced("camera = \"a\"", "camera = \"spare\"\n[[view.source]]\ncamera = \"a\"",
                   recipe("one")));
    std::string sharp = recipe("one");
    for (const char* sharpness : {"0.7", "0", "0.6"}) {
      sharp += std::string("[[view.source]]\ncamera = \"a\"\nsharpness = ") + sharpness + "\n";
    }
    write("sharp.toml", sharp);
    write("sharper.toml", replaced("sharpness = 0\n", "sharpness = 0.5\n", sharp));
    write("sharpest.toml", replaced("sharpness = 0.6\n", "sharpness = 0.4\n", sharp));
    write("input.toml",
          recipe("one", "", "process_active = \"input\"\nprocess_input = \"laser\"\n"));
    write("output.toml",
          recipe("one", "", "process_active = \"input\"\nprocess_input = \"flash\"\n"));
    write("bad.toml", replaced("width = 32", "width = 0", recipe("one")));
    std::string views = recipe("v0");
    for (int i = 1; i < 16; ++i) {
      views += "[[view]]\nname = \"v" + std::to_string(i) +
               "\"\nmeasured = \"a\"\nwidth = 9\nheight = 9\n[[view.source]]\ncamera = \"a\"\n";
    }
    write("sixteen.toml", views);
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name) << text;
  }
};

TEST_F(ConfigurationWithRecipes, ACameraMayBeSharpenedInAFewWays) {
  for (const char* few : {"sharp.toml", "sharper.toml"}) {
    const auto parsed = parse(with_recipes({few}));
    EXPECT_TRUE(parsed) << parsed.error().message;
  }
  const auto refused = parse(with_recipes({"sharper.toml", "sharpest.toml"}));
  ASSERT_FALSE(refused);
  for (const char* part : {"/sharpest.toml:", "view.source.sharpness", "0.8, 0.7, 0.5, 0.6"}) {
    EXPECT_NE(refused.error().message.find(part), std::string::npos) << refused.error().message;
  }
}

TEST_F(ConfigurationWithRecipes, TheFirstIsMeasuredAndViewsOfOneNameAreOne) {
  const auto c = parse(with_recipes({"one.toml", "two.toml", "again.toml"}));
  ASSERT_TRUE(c) << c.error().message;
  ASSERT_EQ(c->recipes.size(), 3U);
  EXPECT_EQ(c->site.recipes[0].number, 10);
  EXPECT_EQ(c->recipes[0].name, "one");
  EXPECT_EQ(c->site.recipes[1].file.path, folder / "two.toml") << "from the file's folder";
  EXPECT_EQ(c->names.views, (std::vector<std::string>{"front", "one", "two"}));
}

TEST_F(ConfigurationWithRecipes, EveryRecipeMaySetWhatAllSet) {
  const auto c = parse(with_recipes({"exposure.toml", "longer.toml"}));
  ASSERT_TRUE(c) << c.error().message;
  EXPECT_EQ(c->recipes[1].controls[0].value, 1600);
}

TEST_F(ConfigurationWithRecipes, NeedsNoViewBesidesThoseOfRecipes) {
  const std::string views = kValid.substr(kValid.find("[[view]]"));
  EXPECT_TRUE(parse(with_recipes({"one.toml"}, replaced(views, ""))));
  const auto none = parse(replaced(views, ""));
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("view: 0 are given"), std::string::npos);
}

TEST_F(ConfigurationWithRecipes, HasSnapshotsAndRadiometry) {
  const auto c = parse(replaced("[camera.replay]",
                                "kelvin_per_count = 0.04\n[camera.radiometry]\nwavelength = 4\n"
                                "ball_reflectivity = 0.8\n[camera.replay]") +
                       "[snapshot]\nfolder = \"pictures\"\n");
  ASSERT_TRUE(c) << c.error().message;
  const auto& snapshot = std::get<SnapshotSettings>(c->site.sinks);
  EXPECT_EQ(snapshot.folder, folder / "pictures");
  EXPECT_EQ(snapshot.keep, 100);
  const signals::RadiometrySettings& radiometry = c->site.cameras[0].radiometry;
  EXPECT_EQ(radiometry.wavelength, 4);
  EXPECT_EQ(radiometry.reflectivity, 0.8);
  EXPECT_EQ(radiometry.ball_temperature, 20);
  EXPECT_TRUE(std::get<SnapshotSettings>(parse(kValid)->site.sinks).folder.empty());
  const auto no_folder = parse(kValid + "[snapshot]\nkeep = 5\n");
  ASSERT_FALSE(no_folder);
  EXPECT_NE(no_folder.error().message.find("snapshot.folder: is missing"), std::string::npos)
      << no_folder.error().message;
}

TEST_F(ConfigurationWithRecipes, TheChecksumChangesWithEachOfTheFilesAndOnlyThen) {
  write("lens.yaml", R"(image_width: 100
image_height: 80
camera_name: a
camera_matrix: {rows: 3, cols: 3, data: [900, 0, 49.5, 0, 900, 39.5, 0, 0, 1]}
distortion_model: plumb_bob
distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}
)");
  write("rig.toml",
        replaced("[camera.outline]", "[camera.intrinsics]\nfile = \"lens.yaml\"\n[camera.outline]",
                 replaced("alpha = 340\n", "", kRig)));
  std::string text = with_recipes({"one.toml", "two.toml"});
  const auto checksum = [&] {
    const auto c = parse(text);
    EXPECT_TRUE(c) << c.error().message;
    return c ? c->checksum : 0;
  };
  const std::uint32_t before = checksum();
  std::set<std::uint32_t> seen{before};
  EXPECT_EQ(checksum(), before);
  for (const char* file : {"rig.toml", "lens.yaml", "one.toml", "two.toml"}) {
    std::ofstream(folder / file, std::ios::app) << "# another\n";
    EXPECT_TRUE(seen.insert(checksum()).second) << file;
  }
  const std::uint32_t others = checksum();
  text += "# another\n";
  EXPECT_TRUE(seen.insert(checksum()).second) << "this one";
  text.erase(text.rfind('#'));
  write("again.toml", recipe("three"));
  write("broken.toml", "is none of them");
  EXPECT_EQ(checksum(), others);
}

class RefusedTogether : public ConfigurationWithRecipes,
                        public testing::WithParamInterface<Refusal> {};

TEST_P(RefusedTogether, SaysFileLineKeyAndWhatIsAllowed) {
  const auto c = parse(GetParam().text);
  ASSERT_FALSE(c);
  expect_said(GetParam(), c.error());
}

INSTANTIATE_TEST_SUITE_P(
    All, RefusedTogether,
    testing::Values(
        Refusal{"RecipeFileMissing",
                with_recipes({"nowhere.toml"}),
                {"site.toml:17: recipe.file: ", "/nowhere.toml: cannot be read"}},
        Refusal{"RecipeBroken",
                with_recipes({"one.toml", "bad.toml"}),
                {"site.toml:20: recipe.file: ", "/bad.toml:5: view.width"}},
        Refusal{"RecipeNumberTwice",
                replaced("= 20", "= 10", with_recipes({"one.toml", "two.toml"})),
                {"site.toml:18: recipe.number: 10 is there twice"}},
        Refusal{"RecipeNumberZero",
                replaced("= 10", "= 0", with_recipes({"one.toml"})),
                {"recipe.number", "1 to 65535"}},
        Refusal{"RecipeViewIsADisplayView",
                with_recipes({"display.toml"}),
                {"/display.toml:2: view.name: \"front\"", "already"}},
        Refusal{"RecipeViewIsReserved",
                with_recipes({"selected.toml"}),
                {"/selected.toml:2: view.name", "selected"}},
        Refusal{"RecipeShowsACameraThatIsNotThere",
                with_recipes({"source.toml"}),
                {"/source.toml:7: view.source.camera", "\"spare\"", "there are: a"}},
        Refusal{"RecipeSetsACameraThatIsNotThere",
                with_recipes({"nobody.toml"}),
                {"/nobody.toml:13: control.camera", "\"b\"", "there are: a"}},
        Refusal{"OnlyOneRecipeSetsIt",
                with_recipes({"exposure.toml", "two.toml"}),
                {"/exposure.toml:13: control.name: recipe 20 does not set a's ExposureTime"}},
        Refusal{"RecipeSetsItTwice",
                with_recipes({"twice.toml"}),
                {"/twice.toml:13: control.name: recipe 10 sets twice a's ExposureTime"}},
        Refusal{"RecipeSetsWhatTheConfigurationSets",
                with_recipes({"exposure.toml"},
                             replaced("[camera.replay]",
                                      "[[camera.control]]\nname = \"ExposureTime\"\nvalue = 1\n"
                                      "[camera.replay]")),
                {"/exposure.toml:13: control.name", "set by the configuration already"}},
        Refusal{"ProcessInputThatIsNotThere",
                with_recipes({"input.toml"}),
                {"/input.toml:1: process_input", "\"laser\"", "process_input"}},
        Refusal{"ProcessInputThatIsAnOutput",
                with_recipes({"output.toml"}, kValid + kLines),
                {"/output.toml:1: process_input", "\"flash\"", "start, flash"}},
        Refusal{"EventsOfAnInputThatIsNotThere",
                kValid + kLines +
                    "[recorder]\nfolder = \"r\"\n[recorder.events]\nring_mib = 64\n"
                    "on_lines = [\"start\"]\n",
                {"recorder.events.on_lines", "\"start\" with use process_input", "start, flash"}},
        Refusal{"TooManyViewsTogether",
                with_recipes({"sixteen.toml"}),
                {"view: 17 are given", "1 to 16"}},
        Refusal{"RadiometryOfACameraWithoutAScale",
                replaced("[camera.replay]", "[camera.radiometry]\n[camera.replay]"),
                {"camera.radiometry", "kelvin_per_count"}},
        Refusal{"BlackBall",
                replaced("[camera.replay]",
                         "kelvin_per_count = 0.04\n[camera.radiometry]\nball_reflectivity = 0\n"
                         "[camera.replay]"),
                {"camera.radiometry.ball_reflectivity", "0.05 to 1"}},
        Refusal{"OffsetWithoutAScale",
                replaced("[camera.replay]", "kelvin_offset = 273.15\n[camera.replay]"),
                {"camera.kelvin_offset", "needs kelvin_per_count"}},
        Refusal{"SnapshotsNowhere", kValid + "[snapshot]\nkeep = 5\n", {"snapshot.folder"}},
        Refusal{"NoSnapshotStays",
                kValid + "[snapshot]\nfolder = \"p\"\nkeep = 0\n",
                {"snapshot.keep", "1 to 100000"}}),
    [](const auto& refusal) { return refusal.param.name; });

}  // namespace
}  // namespace orbwatch::app::files
