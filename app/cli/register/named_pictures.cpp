// SPDX-License-Identifier: Apache-2.0
#include "app/cli/register/named_pictures.h"

#include <utility>

#include "app/cli/options/options.h"
#include "hal/replay/picture_folder.h"

namespace orbwatch::app::cli {
std::vector<Picture> NamedPictures::views() const {
  std::vector<Picture> all;
  for (const hal::DecodedPicture& decoded : pictures) all.push_back(decoded.picture);
  return all;
}

CliResult<NamedPictures> read_named_pictures(const std::string& word) {
  const std::size_t equals = word.find('=');
  if (equals == 0 || equals == std::string::npos || equals + 1 == word.size()) {
    return usage_error("\"" + word + "\" is not CAMERA=PATH");
  }
  NamedPictures named{word.substr(0, equals), {}};
  auto files = hal::pictures_in(word.substr(equals + 1));
  if (!files) return tl::unexpected(files.error());
  if (files->size() > kMostPictures) files->resize(kMostPictures);
  for (const std::filesystem::path& file : *files) {
    auto decoded = hal::read_picture(file);
    if (!decoded) return tl::unexpected(decoded.error());
    named.pictures.push_back(std::move(*decoded));
    const Picture &first = named.pictures.front().picture, &last = named.pictures.back().picture;
    if (last.width != first.width || last.height != first.height || last.format != first.format) {
      return fail(file.string() + " is of another size or kind than the pictures before it" +
                  exif_note(named.pictures.back()));
    }
  }
  return named;
}

}  // namespace orbwatch::app::cli
