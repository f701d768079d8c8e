#!/bin/sh
# Runs the commands of README.md, doc/tutorial.md and doc/three_days.md as a newcomer does, in an empty folder: those in
# blocks ```sh, after files in blocks ```ini NAME. Checks of all pages: links lead to files and headings, keys after --set exist, and no page
# says "not yet", which becomes wrong without a change of the page. calibrate may end with 3: after a short drive some
# numbers stay open.
#   pages.sh SCANLOOM SOURCE_DIR links|README.md|doc/tutorial.md|doc/three_days.md
set -eu
program=$1 source=$2 what=$3
dir=$(mktemp -d)
trap 'rm -rf "$dir"' EXIT
PATH=$(dirname "$program"):$PATH
cd "$source"

headings() {  # as GitHub makes anchors of them
  sed -n 's/^##* //p' "$1" | tr '[:upper:]' '[:lower:]' | sed 's/\[\([^]]*\)\]([^)]*)/\1/g; s/[^a-z0-9 _-]//g; s/ /-/g'
}

pages=$(find README.md CHANGELOG.md doc datasets .github -name '*.md')
wrong=0
complain() { echo "$1" >&2; wrong=1; }

if [ "$what" = links ]; then
  for page in $pages; do
    for link in $(sed 's/`[^`]*`//g' "$page" | grep -o ']([^) ]*)' | sed 's/^](//; s/)$//' | grep -v '^http' || true); do
      file=${link%%#*} anchor=${link#"$file"}
      target=$([ "$file" ] && echo "$(dirname "$page")/$file" || echo "$page")
      [ -e "$target" ] || { complain "$page: $link leads to no file"; continue; }
      [ -z "$anchor" ] || headings "$target" | grep -qx -- "${anchor#\#}" || complain "$page: $link leads to no heading"
    done
  done

  { scanloom config --parameters; scanloom config --parameters laboratory; } > "$dir/parameters.md"
  for key in $(cat $pages | grep -oE -- '--set [a-z_0-9]+\.[a-z_0-9]+=' | sed 's/--set //; s/=//' | grep -v '^section.key' | sort -u); do
    sed -n "/^## \[${key%%.*}\]/,/^## /p" "$dir/parameters.md" | grep -q "^| \`${key#*.}\`" || complain "--set $key: no such key"
  done

  if grep -niE 'not (read |measured |supported )?yet' $(echo "$pages" | grep -v CHANGELOG) params/*.ini; then
    complain "these lines promise: say what is"
  fi
  exit $wrong
fi

awk '/^```sh$/ { run = 1; next }
     /^```ini / { run = 1; file = 1; print "cat > " $2 " <<\"END\""; next }
     /^```$/ { if (file) print "END"; run = file = 0; next }
     run && $2 == "calibrate" { sub(/  +#.*/, ""); print $0 " || [ $? = 3 ]"; next }
     run' "$what" > "$dir/commands"
cd "$dir"
ln -s "$source/params" params
[ "$what" != README.md ] ||
  scanloom simulate -c params/simulation/demo.ini --set simulated_drive.duration=30 --out-dir build/demo/recording > /dev/null 2>&1
sh -eux commands
