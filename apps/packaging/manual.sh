#!/bin/sh
# manual.sh HELP2MAN PROGRAM VERSION FOLDER: the manual pages scanloom(1) and scanloom-VERB(1), from --help.
set -eu
help2man=$1 program=$2 version=$3 folder=$4
mkdir -p "$folder"
rm -f "$folder"/*.1.gz

page() {  # NAME PURPOSE COMMAND...
  name=$1 purpose=$2
  shift 2
  "$help2man" --no-info --name "$purpose" --version-string "$version" --source "scanloom $version" "$*" |
    sed -e "s/^\.TH [^ ]*/.TH $(echo "$name" | tr '[:lower:]' '[:upper:]')/" -e "/^\.SH NAME/,/^\.SH SYNOPSIS/s/^scanloom [a-z]* /$name /" |
    gzip -9n > "$folder/$name.1.gz"
}

"$program" --help | awk 'tolower($0) ~ /^verbs:/ { verbs = 1; next } !NF { verbs = 0 } verbs' | while read -r verb purpose; do
  [ "$verb" = help ] || page "scanloom-$verb" "$purpose" "$program" "$verb"
done
page scanloom "merges the packets of several lidars, localises with them, makes maps" "$program"
