# Made by: orbwatch describe completion
_orbwatch() {
  local words="" line="${COMP_WORDS[*]:1:COMP_CWORD-1} "
  case $line in
    " ") words="project advise setup detect register place drift replay calibration subscribe state command password dds-keys list doctor support backup restore reset update configure events lines bench describe --help --version" ;;
    "project "*) words="--output --rig --camera --ball --alpha --distance --rotation --model --view --yaw --pitch --roll --h-fov --v-fov --size --undefined --interpolation --sharpness --match --camera-info --help" ;;
    "advise "*) words="--ball-diameter --distance --focal --pixel --sensor --target-distance --smallest --json --help" ;;
    "setup "*) words="--output --ball-diameter --camera --calibration --distance --pose --ball-centre --box --obstacle --page --force --json --help" ;;
    "detect "*) words="--json --overlay --calibration --help" ;;
    "register "*) words="--rig --method --detect --refine-outline --json --output --help" ;;
    "place "*) words="--rig --camera --point --view-point --image --tag --tags --focal --ball-centre --sigma-px --sigma-mm --outline-sigma --json --output --view --yaw --pitch --roll --h-fov --v-fov --size --help" ;;
    "drift "*) words="--rig --rate --reference --warning --alarm --json --help" ;;
    "replay "*) words="--recipe --compare --tolerance --settle --output --help" ;;
    "calibration "*) words="--config --json --help" ;;
    "subscribe "*) words="--topic --domain --prefix --security --save --seconds --count --stats --each --json --help" ;;
    "state "*) words="--json --follow --domain --prefix --security --timeout --help" ;;
    "command "*) words="--domain --prefix --security --timeout --help select_view pulse start stop select_recipe point_view mix_sources trigger acknowledge_alarm snapshot set_process_active restart detect_ball register_camera correct_alignment accept_alignment discard_alignment learn_clean_ball mark_point forget_points place_camera move_outline shape_outline turn_camera undo_alignment revert_alignment pick_pixel set_colour_map set_colour_range forget_point cancel_alignment record_event" ;;
    "password "*) words="--config --role --show --help" ;;
    "dds-keys "*) words="--subscriber --read-only --domain --prefix --days --replace --help" ;;
    "list "*) words="--json --appliances --seconds --domain --security --help" ;;
    "doctor "*) words="--config --json --help" ;;
    "support "*) words="--output --config --figures --pictures --help" ;;
    "backup "*) words="--output --config --passphrase-file --without-secrets --with-events --help" ;;
    "restore "*) words="--config --camera --passphrase-file --without-secrets --without-events --check --json --at-start --undo --pending --help" ;;
    "reset "*) words="--factory --config --from --check --at-start --help" ;;
    "update "*) words="--reboot --skip-failed --help" ;;
    "configure "*) words="--config --seconds --dry-run --confirm --cancel --help" ;;
    "events "*) words="--config --folder --json --output --camera --from --to --draw --force --help" ;;
    "lines "*) words="--safe --config --help" ;;
    "bench "*) words="--config --seconds --simulated --json --help" ;;
    "describe config"*) words="--help" ;;
    "describe rig"*) words="--help" ;;
    "describe recipe"*) words="--help" ;;
    "describe registers"*) words="--format --help" ;;
    "describe http"*) words="--help" ;;
    "describe view"*) words="--rig --camera --ball --alpha --distance --rotation --model --size-of-picture --view --yaw --pitch --roll --h-fov --v-fov --size --json --output --help" ;;
    "describe camera"*) words="--rig --camera --format --json --help" ;;
    "describe man"*) words="--help" ;;
    "describe completion"*) words="--help" ;;
    "describe "*) words="config rig recipe registers http view camera man completion" ;;
  esac
  mapfile -t COMPREPLY < <(compgen -W "$words" -- "${COMP_WORDS[COMP_CWORD]}")
}
complete -o bashdefault -o default -F _orbwatch orbwatch
