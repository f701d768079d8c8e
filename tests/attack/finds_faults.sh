#!/bin/sh
# The attack itself must find a crash, a failure without a word, a wrong status and hunger for memory: here a program
# has them one after the other, with damaged files only.
#   finds_faults.sh SCANLOOM_ATTACK SCANLOOM
set -eu
folder=$(mktemp -d)
trap 'rm -r "$folder"' EXIT
cat >"$folder/faulty" <<END
#!/bin/sh
case "\$*" in */hit/*) ;; *) exec "$2" "\$@" ;; esac
echo >>"$folder/calls"
case \$((\$(wc -l <"$folder/calls") % 4)) in
  0) kill -SEGV \$\$ ;;
  1) exit 1 ;;
  2) exit 9 ;;
  3) head -c 500000000 /dev/zero | tail -c 500000000 >/dev/null ;;
esac
END
chmod +x "$folder/faulty"
if "$1" "$folder/faulty" --seconds 20 --only extrinsics --folder "$folder/attack" >"$folder/log"; then
  echo "no fault was found" && cat "$folder/log" && exit 1
fi
for fault in "crashes with signal 11" "fails without a word" "ends with status 9" "takes 5.. MB"; do
  grep -q "$fault" "$folder/log" || { echo "not found: $fault" && cat "$folder/log" && exit 1; }
done
