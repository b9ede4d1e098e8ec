// SPDX-License-Identifier: Apache-2.0
// German texts of support file, backup, restore, factory reset and update.
export const device = {
  title: "Gerät",
  passphrase: "Passphrase",
  making: "Die Datei wird erstellt; das kann eine Minute dauern.",
  made: (mebibytes) => `Erstellt: ${mebibytes} MiB. Der Browser speichert die Datei.`,
  restarts: "Das Gerät startet neu. Die Seite in einer Minute neu laden.",
  support: {
    title: "Supportdatei",
    help: "Eine Datei für den technischen Support: Befunde, Versionen, Protokoll, Werte der letzten zehn Minuten, " +
      "Konfiguration. Sie enthält kein Geheimnis.",
    pictures: "mit den neuesten Bildern",
    make: "Supportdatei erstellen",
  },
  backup: {
    title: "Sicherung",
    help: "Konfiguration, Rezepte, Ausrichtungen, Benutzer, Zertifikate und Schlüssel in einer Datei, mit der ein " +
      "Ersatzgerät weiterarbeitet. Ohne Passphrase fehlen Benutzer, Zertifikate und Schlüssel.",
    events: "mit den behaltenen Ereignissen des Rekorders, unverschlüsselt",
    make: "Sicherung erstellen",
  },
  restore: {
    title: "Wiederherstellung",
    help: "Die Sicherung wird zuerst geprüft. Ohne ihre Passphrase bleiben Benutzer, Zertifikate und Schlüssel " +
      "dieses Geräts.",
    file: "Datei",
    events: "mit den enthaltenen Ereignissen",
    change: "Änderung",
    changes: "Dateien der Sicherung",
    words: { new: "neu", changed: "geändert", same: "gleich" },
    check: "Sicherung prüfen",
    sent: (share) => `Hochgeladen: ${Math.round(100 * share)} %`,
    of: ({ host, made, version }) => `Sicherung von ${host}, ${made}, orbwatch ${version}`,
    notRestored: "Nicht wiederhergestellt, weil geheim:",
    leftOut: "Nicht in der Sicherung:",
    notes: "Hängt vom Gerät ab:",
    camera: "Gerät der Kamera",
    run: "Wiederherstellen und neu starten",
    asks: "Die Dateien dieses Geräts werden durch die der Sicherung ersetzt, und das Gerät startet neu. " +
      "Wiederherstellen?",
  },
  reset: {
    title: "Werkseinstellung",
    help: "Die ausgelieferte Konfiguration läuft wieder. Alle andere Konfiguration, Ausrichtungen, Benutzer, " +
      "Zertifikate, Schlüssel und Verläufe werden gelöscht; Aufzeichnungen bleiben.",
    confirmation: (words) => `Zur Bestätigung eingeben: ${words}`,
    run: "Zurücksetzen und neu starten",
  },
  update: {
    title: "Aktualisierung",
    byPackages: "Dieser Rechner läuft nicht mit einem Image mit zwei Slots: Aktualisierungen kommen über seine Pakete.",
    running: ({ version, slot }) => `Version ${version} läuft in Slot ${slot}.`,
    trial: ({ trial, other, reason, kept_in, returns_in }) => ({
      kept: "Sie bleibt.",
      on_trial: kept_in === null ?
        `Sie läuft auf Probe und arbeitet noch nicht; das Gerät kehrt in ${returns_in} s zurück.` :
        `Sie läuft auf Probe und bleibt, wenn sie noch ${kept_in} s arbeitet.`,
      installed: `Version ${other} ist installiert und wird beim nächsten Start erprobt.`,
      returned: `Das Gerät ist von Version ${other} zurückgekehrt: ${reason}.`,
    })[trial],
    work: {
      checking: () => "Die Aktualisierung wird geprüft.",
      installing: ({ percent, step }) => `Die Aktualisierung wird installiert: ${percent} %, ${step}`,
    },
    file: "Aktualisierung (.raucb)",
    run: "Hochladen und installieren",
    restart: "Neu starten und erproben",
    asks: "Das Gerät startet mit der neuen Version und kehrt zur jetzigen zurück, wenn Kameras oder Schnittstellen " +
      "nicht arbeiten. Neu starten?",
  },
};
