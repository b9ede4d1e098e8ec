// SPDX-License-Identifier: Apache-2.0
#include "app/update/install_update.h"

#include "app/update/refusal.h"

namespace orbwatch::app::update {
namespace {

tl::unexpected<Error> refuse(const Update& update, const std::string& reason) {
  return fail(update.name + " is refused: " + reason);
}

/// Version of a bundle that this device may install.
Result<std::string> check_bundle(const ImageFiles& image, Installer& installer,
                                 const Update& update) {
  const auto device = installer.compatible();
  if (!device) return fail("RAUC does not answer: " + device.error().message);
  const auto label = installer.inspect(update.bundle);
  if (!label) return refuse(update, refusal_of_bundle(label.error().message));
  const auto tried = image.tried();
  const auto refusal =
      refusal_of({.version = label->version,
                  .compatible = label->compatible,
                  .installed = image.version().value_or(""),
                  .device = *device,
                  .returned_from = update.skips_failed && tried ? tried->version : ""});
  if (refusal) return refuse(update, *refusal);
  return label->version;
}

}  // namespace

Result<> check_device(const ImageFiles& image) {
  const auto running = image.version();
  if (!running) {
    return fail("this computer does not run an image of platform/build-image; update its packages");
  }
  if (!image.accepts_updates()) {
    return fail("this device accepts no update: its image was built without --cert");
  }
  if (image.trial()) {
    return fail("version " + *running + " is on trial; repeat this when it has been kept");
  }
  return {};
}

Result<std::string> install_update(const ImageFiles& image, Installer& installer,
                                   const Update& update) {
  if (auto may = check_device(image); !may) return tl::unexpected(may.error());
  auto version = check_bundle(image, installer, update);
  if (!version) return version;
  if (auto room = image.prepare_record(*version); !room) return tl::unexpected(room.error());
  if (const auto done = installer.install(update.bundle, update.on_progress); !done) {
    return fail(update.name + " is not installed: " + done.error().message);
  }
  if (auto kept = image.keep_record(); !kept) return tl::unexpected(kept.error());
  return version;
}

}  // namespace orbwatch::app::update
