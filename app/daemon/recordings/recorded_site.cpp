// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/recordings/recorded_site.h"

#include <algorithm>
#include <utility>

#include "app/files/runtime/calibration_file.h"
#include "app/model/sink/recorded_texts.h"

namespace orbwatch::app::daemon {
namespace {

namespace fs = std::filesystem;

/// Place of an attachment for resolve(): below the recording itself, where no file can be, so that
/// none of this computer takes the place of a missing one.
fs::path place_of(const fs::path& recording, const fs::path& name) {
  const fs::path outside = name.lexically_relative(kRecordedOutside);
  const bool is_outside = !outside.empty() && *outside.begin() != "..";
  return is_outside ? "/" / outside : recording / name;
}

Result<files::FileTexts> texts_in(const fs::path& file, hal::mcap::Reader& reader) {
  files::FileTexts texts;
  std::size_t bytes = 0;
  const auto& attachments = reader.summary().attachments;
  for (std::size_t k = 0; k < attachments.size(); ++k) {
    const auto attachment = reader.attachment(k);
    if (!attachment) return fail(attachment.error().message);
    bytes += attachment->data.size();
    if (bytes > files::kMostTexts) return fail(file.string() + ": attachments of more than 64 MiB");
    const auto* const begin = reinterpret_cast<const char*>(attachment->data.data());
    texts[place_of(file, attachment->name)] = {begin, attachment->data.size()};
  }
  // Without alignments: an empty file of them, not that of this computer.
  texts.try_emplace(place_of(file, kRecordedCalibration));
  return texts;
}

/// The attachment that is the configuration file: beside the recipes and rigs, it alone can be
/// read as one.
Result<std::pair<fs::path, files::Configuration>> configuration_in(const fs::path& file,
                                                                   const files::FileTexts& texts) {
  std::string reason = "; it has no attachments";
  for (const auto& [path, text] : texts) {
    if (path.parent_path() != file || path.extension() != ".toml") continue;
    auto site = files::read_site(path, texts);
    if (site) return std::pair{path, std::move(*site)};
    reason = "; " + site.error().message;
  }
  return fail(file.string() + ": no configuration in it" + reason);
}

Result<> replace_recipes(const files::Configuration& site, const OtherRecipes& others,
                         files::FileTexts& texts) {
  for (const auto& [number, text] : others) {
    const auto recipe = std::ranges::find(site.recipes, number, &files::RecipeFile::number);
    if (recipe == site.recipes.end()) {
      return fail("the recording has no recipe " + std::to_string(number));
    }
    texts[recipe->file.path] = text;
  }
  return {};
}

}  // namespace

Result<files::Resolved> recorded_site(const fs::path& file, hal::mcap::Reader& reader,
                                      const OtherRecipes& others) {
  auto texts = texts_in(file, reader);
  if (!texts) return tl::unexpected(texts.error());
  const auto found = configuration_in(file, *texts);
  if (!found) return tl::unexpected(found.error());
  const auto& [path, configuration] = *found;
  if (auto done = replace_recipes(configuration, others, *texts); !done) {
    return tl::unexpected(done.error());
  }
  auto site = files::resolve(path, *texts, place_of(file, kRecordedCalibration).parent_path());
  if (!site) return site;
  for (const auto& [read, text] : site->texts) {
    if (!texts->contains(read)) {
      return fail(path.string() + ": names " + read.string() + ", which is not in the recording");
    }
  }
  return site;
}

}  // namespace orbwatch::app::daemon
