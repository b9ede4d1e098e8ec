// SPDX-License-Identifier: Apache-2.0
// Japanese texts of support file, backup, restore, factory reset and update.
export const device = {
  title: "装置",
  passphrase: "パスフレーズ",
  making: "作成中です。1 分ほどかかることがあります。",
  made: (mebibytes) => `作成しました: ${mebibytes} MiB。ブラウザーが保存します。`,
  restarts: "装置が再起動します。1 分後にページを再読み込みしてください。",
  support: {
    title: "サポートファイル",
    help: "技術サポート用のファイルです。診断結果、バージョン、ログ、直近 10 分間の値、設定を含みます。" +
      "機密情報は含みません。",
    pictures: "最新の画像を含める",
    make: "サポートファイルを作成",
  },
  backup: {
    title: "バックアップ",
    help: "設定、レシピ、位置合わせ、ユーザー、証明書、鍵を 1 つのファイルにまとめます。交換した装置はこのファイルから引き継ぎます。" +
      "パスフレーズがない場合、ユーザー、証明書、鍵は含まれません。",
    events: "保持した記録イベントを含める（暗号化されません）",
    make: "バックアップを作成",
  },
  restore: {
    title: "復元",
    help: "バックアップは最初に検査されます。パスフレーズがない場合、この装置のユーザー、証明書、鍵はそのまま残ります。",
    file: "ファイル",
    events: "含まれるイベントも復元",
    change: "変更",
    changes: "バックアップのファイル",
    words: { new: "新規", changed: "変更あり", same: "同じ" },
    check: "バックアップを検査",
    sent: (share) => `アップロード: ${Math.round(100 * share)} %`,
    of: ({ host, made, version }) => `${host} のバックアップ、${made}、orbwatch ${version}`,
    notRestored: "機密のため復元されないファイル:",
    leftOut: "バックアップに含まれないもの:",
    notes: "装置ごとに異なる設定:",
    camera: "カメラの機器",
    run: "復元して再起動",
    asks: "この装置のファイルがバックアップのファイルに置き換わり、装置が再起動します。復元しますか？",
  },
  reset: {
    title: "初期化",
    help: "出荷時の設定に戻ります。ほかの設定、位置合わせ、ユーザー、証明書、鍵、履歴は削除されます。記録は残ります。",
    confirmation: (words) => `確認のため入力してください: ${words}`,
    run: "初期化して再起動",
  },
  update: {
    title: "更新",
    byPackages: "このコンピューターは 2 スロットのイメージで動作していません。更新はパッケージで行います。",
    running: ({ version, slot }) => `バージョン ${version} がスロット ${slot} で動作しています。`,
    trial: ({ trial, other, reason, kept_in, returns_in }) => ({
      kept: "このバージョンは確定しています。",
      on_trial: kept_in === null ? `試用中で、まだ正常に動作していません。${returns_in} 秒後に元のバージョンに戻ります。` :
        `試用中です。あと ${kept_in} 秒正常に動作すると確定します。`,
      installed: `バージョン ${other} がインストールされ、次回の起動時に試されます。`,
      returned: `バージョン ${other} から元に戻りました: ${reason}`,
    })[trial],
    work: {
      checking: () => "更新を検査しています。",
      installing: ({ percent, step }) => `更新をインストールしています: ${percent} %、${step}`,
    },
    file: "更新 (.raucb)",
    run: "アップロードしてインストール",
    restart: "再起動して試す",
    asks: "新しいバージョンで再起動します。カメラまたはインターフェースが動作しない場合は現在のバージョンに戻ります。再起動しますか？",
  },
};
