#!/bin/sh
# On a Slurm cluster of one node that lives on the loopback for this test, a sweep as a job array gives the rows of the
# same sweep on local cores, one failed run among them, and the jobs of doc/site.md give the bits of a site on local
# cores. Skips (77) where Slurm is not installed.
#   slurm_engine.sh SCANLOOM SOURCE_DIR
set -eu
scanloom=$1
experiment=$2/params/experiments/small.ini

for program in slurmctld slurmd sbatch sinfo; do
  command -v $program >/dev/null || { echo "skipped: $program is not installed"; exit 77; }
done
[ "$(id -u)" = 0 ] || { echo "skipped: slurmd starts jobs as root only"; exit 77; }

dir=$(mktemp -d)
node=$(hostname -s)
mkdir "$dir/state" "$dir/spool"
cat >"$dir/slurm.conf" <<EOF
ClusterName=loopback
SlurmctldHost=$node(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/none
CredType=cred/none
SlurmctldPort=16817
SlurmdPort=16818
StateSaveLocation=$dir/state
SlurmdSpoolDir=$dir/spool
SlurmctldPidFile=$dir/slurmctld.pid
SlurmdPidFile=$dir/slurmd.pid
SlurmctldLogFile=$dir/slurmctld.log
SlurmdLogFile=$dir/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
MpiDefault=none
NodeName=$node NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES State=UP
EOF
# From Slurm 23 on slurmd does not start without cgroups, as in a container or chroot, unless told so; Slurm 22 does, and
# does not know the key.
[ "$(slurmd -V | sed 's/[^0-9]*\([0-9]*\).*/\1/')" -lt 23 ] || echo CgroupPlugin=disabled >"$dir/cgroup.conf"
export SLURM_CONF="$dir/slurm.conf"
slurmctld -D >/dev/null 2>&1 &
controller=$!
slurmd -D >/dev/null 2>&1 &
daemon=$!
trap 'kill $controller $daemon 2>/dev/null; wait; rm -rf "$dir"' EXIT

isIdle() { case $(sinfo -h -o %T 2>/dev/null) in *idle*) ;; *) false ;; esac; }
for _ in $(seq 60); do
  isIdle && break
  sleep 0.5
done
isIdle || { echo "the node does not start"; cat "$dir"/*.log; exit 1; }

sweep() { # ENGINE: of its two drives one ends before there is a pose, so its run fails
  status=0
  "$scanloom" experiment -c "$experiment" --set experiment.lidars=left \
    --set experiment.axis1_name=simulated_drive.duration --set "experiment.axis1_values=0.05 | 20" \
    --engine "$1" --out-dir "$dir/$1" || status=$?
  [ $status = 4 ] || { echo "$1: status $status, expected 4"; cat "$dir"/*.log "$dir/$1"/slurm/* || true; exit 1; }
}
sweep slurm
sweep local

for engine in slurm local; do
  cut -d , -f 1-21 "$dir/$engine/results.csv" >"$dir/$engine.csv" # up to the samples: what follows are times
done
cat "$dir/slurm.csv"
diff "$dir/slurm.csv" "$dir/local.csv"
[ "$(wc -l <"$dir/slurm.csv")" = 3 ]
grep -q ",\(OK\|DEGENERATE\)," "$dir/slurm.csv"
grep -q "slam gave no pose" "$dir/slurm/results.csv"

cd "$dir"
ln -s "$scanloom" scanloom
PATH=$dir:$PATH
for day in monday:0 tuesday:1; do
  scanloom simulate -c "$2/params/simulation/demo.ini" --seed "1${day#*:}" --set simulated_stand.seed=1 \
    --set simulated_drive.duration=35 --set simulated_drive.speed=1.2 --set simulated_drive.day="${day#*:}" --out-dir "${day%:*}"
done
awk '/^```sh$/ { run = 1; next } /^```$/ { run = 0 } run' "$2/doc/site.md" >commands
sh -eu commands
for _ in $(seq 120); do
  [ "$(squeue -h)" ] || break
  sleep 0.5
done
for drive in monday tuesday; do scanloom slam $drive --out-dir ${drive}_local; done
for drive in monday tuesday; do cmp ${drive}_slam/trajectory.tum ${drive}_local/trajectory.tum; done
scanloom site monday_slam tuesday_slam --out-dir here
diff -r here forest
