# bash: verbs, options and keys for --set, asked of the program itself, once for each shell. Its help begins options with
# "  -c,--config", from CLI11 2.6 on "  -c,      --config"; explanations begin at column 30 or later.
declare -gA _scanloom_said

_scanloom_lines() {  # AWK ARGUMENTS...: what the program prints for these arguments, as awk selects it
  local awk=$1
  shift
  [[ -v _scanloom_said[$*] ]] || _scanloom_said[$*]=$(scanloom "$@" 2>/dev/null)
  awk "$awk" <<< "${_scanloom_said[$*]}"
}

_scanloom() {
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} verb=${COMP_WORDS[1]} choice
  if [[ $COMP_CWORD -eq 1 || $before == help || $before == --default ]]; then
    choice=$(_scanloom_lines 'tolower($0) ~ /^verbs:/ { verbs = 1; next } !NF { verbs = 0 } verbs { print $1 }' --help)
  elif [[ $before == --set ]]; then
    choice=$(_scanloom_lines '/^\[/ { section = substr($1, 2, length($1) - 2) } /^[a-z][a-z0-9_]* =/ { print section "." $1 "=" }' \
                             config --default "$verb")
    compopt -o nospace
  elif [[ $word == -* ]]; then
    choice=$(_scanloom_lines 'match($0, /^ +(-[A-Za-z], *)?--[a-z][a-z0-9-]*/) && RLENGTH < 30 { name = substr($0, 1, RLENGTH); sub(/.* |.*,/, "", name); print name }' help "$verb")
  fi
  COMPREPLY=($(compgen -W "$choice" -- "$word"))
}
complete -o default -F _scanloom scanloom
