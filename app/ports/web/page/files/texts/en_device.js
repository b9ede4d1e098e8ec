// SPDX-License-Identifier: Apache-2.0
// English texts of support file, backup, restore, factory reset and update.
export const device = {
  title: "Device",
  passphrase: "Passphrase",
  making: "It is being made; this may take a minute.",
  made: (mebibytes) => `Made: ${mebibytes} MiB. The browser saves it.`,
  restarts: "The appliance restarts. Load the page again in a minute.",
  support: {
    title: "Support file",
    help: "One file for technical support: findings, versions, log, figures of the last ten minutes, " +
      "configuration. It has no secret.",
    pictures: "with the newest pictures",
    make: "Make the support file",
  },
  backup: {
    title: "Backup",
    help: "Configuration, recipes, alignments, users, certificates and keys in one file, from which a " +
      "replacement takes over. Without a passphrase users, certificates and keys are left out.",
    events: "with the recorder's kept events, which are not encrypted",
    make: "Make a backup",
  },
  restore: {
    title: "Restore",
    help: "The backup is checked first. Without its passphrase this device's users, certificates and keys are " +
      "kept.",
    file: "File",
    events: "with the events in it",
    change: "Change",
    changes: "Files of the backup",
    words: { new: "new", changed: "changed", same: "the same" },
    check: "Check the backup",
    sent: (share) => `Uploaded: ${Math.round(100 * share)} %`,
    of: ({ host, made, version }) => `Backup of ${host}, ${made}, orbwatch ${version}`,
    notRestored: "Not restored, because they are secret:",
    leftOut: "Not in the backup:",
    notes: "Depends on the device:",
    camera: "Device of the camera",
    run: "Restore and restart",
    asks: "The files of this device are replaced by those of the backup, and the appliance restarts. Restore?",
  },
  reset: {
    title: "Factory reset",
    help: "The delivered configuration runs again. All other configuration, alignments, users, certificates, " +
      "keys and histories are removed; recordings stay.",
    confirmation: (words) => `To confirm, type: ${words}`,
    run: "Reset and restart",
  },
  update: {
    title: "Update",
    byPackages: "This computer does not run an image with two slots: updates come by its packages.",
    running: ({ version, slot }) => `Version ${version} runs in slot ${slot}.`,
    trial: ({ trial, other, reason, kept_in, returns_in }) => ({
      kept: "It is kept.",
      on_trial: kept_in === null ? `It is on trial and does not work yet; the device returns in ${returns_in} s.` :
        `It is on trial, and kept in ${kept_in} s if it works until then.`,
      installed: `Version ${other} is installed, and tried at the next start.`,
      returned: `The device has returned from version ${other}: ${reason}.`,
    })[trial],
    work: {
      checking: () => "The update is being checked.",
      installing: ({ percent, step }) => `The update is being installed: ${percent} %, ${step}`,
    },
    file: "Update (.raucb)",
    run: "Upload and install",
    restart: "Restart and try it",
    asks: "The device restarts with the new version, and returns to the present one if cameras or interfaces do not " +
      "work. Restart?",
  },
};
