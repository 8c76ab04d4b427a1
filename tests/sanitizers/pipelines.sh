#!/bin/bash
# pipelines.sh FOAM FOLDER SHARED: whole pipelines of a program that was built with sanitizers, on robots of others. Exit code 1 if
# one is reported or ends in a way that it should not.
set -u
foam=$(realpath "$1") folder=$2 robots=$3/robots meshes=$3/meshes
mkdir -p "$folder" && cd "$folder" || exit 2
export XDG_CACHE_HOME=$PWD/cache
ur5=$robots/ur5/example-robot-data/robots/ur_description/urdf/ur5_robot.urdf
jaco=$robots/jaco/kinova_description/urdf/j2s7s300.urdf
baxter=$robots/baxter/example-robot-data/robots/baxter_description/baxter_foam.urdf
iiwa=$robots/iiwa/model.urdf panda=$robots/panda/foam_variant/panda.urdf fetch=$robots/fetch/fetch_description/fetch_foam.urdf
number=0 wrong=0

run() { # CODES ARGUMENT...: exit codes that are right, as a pattern
    local codes=$1 code
    shift
    number=$((number + 1))
    "$foam" "$@" > $number.out 2> $number.err
    code=$?
    echo "$number: $code: foam $*"
    if grep -qE "Sanitizer|runtime error" $number.err || ! [[ $code =~ ^($codes)$ ]]; then
        wrong=1
        cat $number.err
    fi
}

run 0 spherize "$ur5" -n 40 -j 2 --fresh -q --effort fast -o spheres.urdf
run "0|1" spherize "$ur5" -n 40 -j 2 --fresh -q --time-limit 0.5 -o hurried.json
run "0|1" spherize "$panda" -n 60 -j 2 --fresh -q --time-limit 15 -o panda.json
run "0|1" spherize "$fetch" -n 60 -j 2 --fresh -q --time-limit 20 -o fetch.json
run 0 spherize "$baxter" -n 60 -j 2 --fresh -q -m grid -o baxter.json
run 0 spherize "$ur5" -j 2 --fresh -q --effort fast --excess 1.5 -o excess.json
run 0 spherize "$iiwa" -n 30 -j 2 --fresh -q --effort fast --set hollow=fill -o filled.json
for where in process none; do
    run 0 spherize "$ur5" -n 40 -j 2 --fresh -q --effort fast --set isolate=$where -o $where.json
    run 0 approximate "$ur5" -n 12 --with swept_box -j 2 --fresh -q --effort fast --set isolate=$where -o $where.urdf
done
for kind in box capsule cylinder hull; do
    run 0 approximate "$ur5" -n 12 --with $kind -j 2 --fresh -q --effort fast -o $kind.urdf
    run 0 evaluate "$ur5" $kind.urdf -j 2 --poses 30
    run 0 certify "$ur5" $kind.urdf -j 2
done
run "0|1" approximate "$jaco" --cost 60 --with sphere,capsule,box -j 2 --fresh -q --time-limit 20 -o mixed.urdf
run 0 self-collision "$ur5" -j 2 --samples 3000 --proof-boxes 2000 --srdf pairs.srdf
run 0 self-collision "$panda" -j 2 --samples 1000 --proof-boxes 1000 --curobo pairs.yml
run 0 convert spheres.urdf "$ur5" -o spheres.xrdf --tool-frame ee_link
run "0|4" batch "$meshes/synthetic" -n 6 -j 2 --run-dir batch
for _ in 1 2; do
    run 0 spherize "$ur5" -n 40 -j 2 -q --effort fast -o cached.json
done
exit $wrong
