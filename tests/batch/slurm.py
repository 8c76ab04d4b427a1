"""A real Slurm on the loopback address: an array, a task that is killed and one that gets SIGTERM, both requeued."""
import contextlib
import os
import pathlib
import pwd
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time

from data_set import Foam, expect, skip, write_boxes

MESHES = 120  # a task works on its half for two or three seconds
PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "scontrol", "squeue", "mungekey")

# As the pages of Slurm 22.05 describe them, without accounting, cgroups and systemd.
CONFIGURATION = """ClusterName=foam
SlurmctldHost={host}(127.0.0.1)
NodeName={host} NodeAddr=127.0.0.1 CPUs={cpus} RealMemory=4000
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CommunicationParameters=NoInAddrAny,NoCtldInAddrAny
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket,cred_expire=5
CredType=cred/munge
SlurmUser=root
SlurmdUser=root
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
SwitchType=switch/none
SchedulerParameters=sched_interval=1,bf_interval=1
ReturnToService=2
KillWait=5
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
"""


def free_ports(count):
    sockets = [socket.socket() for _ in range(count)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [one.getsockname()[1] for one in sockets]
    for one in sockets:
        one.close()
    return ports


def wait_for(condition, what, seconds=60):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            return False
        time.sleep(0.2)
    return True


class Slurm:
    """munged, slurmctld and slurmd as ordinary processes in a folder."""

    def __init__(self, folder):
        self.folder = folder
        self.daemons = []
        self.environment = {**os.environ, "SLURM_CONF": str(folder / "slurm.conf")}

    def __enter__(self):
        host = socket.gethostname().split(".")[0]
        for name in ("state", "spool"):
            (self.folder / name).mkdir()
        (self.folder / "slurm.conf").write_text(CONFIGURATION.format(
            host=host, folder=self.folder, ports=free_ports(2), cpus=os.cpu_count()))
        munge = self.folder / "munge"
        munge.mkdir(mode=0o700)
        user = pwd.getpwnam("munge")
        subprocess.run(["mungekey", "--create", f"--keyfile={munge}/key"], check=True)
        for path in (munge, munge / "key"):
            os.chown(path, user.pw_uid, user.pw_gid)
        os.chown(self.folder, user.pw_uid, user.pw_gid)
        self.start("munged", "--foreground", f"--key-file={munge}/key", f"--socket={self.folder}/munge.socket",
                   f"--pid-file={munge}/pid", f"--log-file={munge}/log", f"--seed-file={munge}/seed", "--force",
                   user=user)
        if not wait_for(lambda: (self.folder / "munge.socket").exists(), "munged", 20):
            self.give_up("munged does not start")
        self.start("slurmctld", "-D")
        self.start("slurmd", "-D", "-N", host)
        if not wait_for(lambda: "idle" in self.run("sinfo", "-h", "-o", "%T"), "slurmd", 60):
            self.give_up("no node is idle: " + self.run("sinfo"))
        return self

    def __exit__(self, *_):
        for daemon in reversed(self.daemons):
            daemon.terminate()
        for daemon in self.daemons:
            try:
                daemon.wait(20)
            except subprocess.TimeoutExpired:
                daemon.kill()

    def start(self, *command, user=None):
        def become():
            if user:
                os.setgid(user.pw_gid)
                os.setuid(user.pw_uid)
        log = open(self.folder / f"{command[0]}.out", "w")
        self.daemons.append(subprocess.Popen(command, env=self.environment, stdout=log, stderr=log, preexec_fn=become))

    def give_up(self, why):
        logs = "\n".join(file.read_text()[-1500:] for file in self.folder.glob("*.out"))
        self.__exit__()
        skip(f"{why}\n{logs}")

    def run(self, *command):
        done = subprocess.run(command, env=self.environment, text=True, capture_output=True)
        return done.stdout + done.stderr

    def states(self, job):
        """Returns the states of the tasks of a job that are not over."""
        return self.run("squeue", "-h", "-r", "-j", job, "-o", "%T").split()


def foam_processes(scratch):
    """Returns the process IDs of foam batch in the scratch folder, without its workers."""
    found = []
    for folder in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            words = (folder / "cmdline").read_bytes().split(b"\0")
        except OSError:
            continue
        if b"batch" in words and any(str(scratch).encode() in word for word in words):
            found.append(int(folder.name))
    return found


def main():
    missing = [name for name in PROGRAMS if not shutil.which(name)]
    if missing:
        skip(f"Slurm is not installed: no {', '.join(missing)}; packages: slurm-wlm munge")
    if os.geteuid() != 0:
        skip("the daemons of Slurm need root")
    # Munge refuses folders that others can write to, as the one for temporary files.
    with tempfile.TemporaryDirectory(dir="/run") as place, tempfile.TemporaryDirectory() as scratch:
        os.chmod(place, 0o755)
        foam, folder = Foam(sys.argv[1], scratch), pathlib.Path(scratch)
        write_boxes(folder / "boxes", MESHES)
        foam("boxes", "-n", 6, "--run-dir", "plain", code=4)
        truth = foam.table("plain")
        foam("boxes", "-n", 6, "--run-dir", "array", "--shards", 4, "--slurm", "--memory-limit", 900)
        script = folder / "array/foam.sbatch"
        script.write_text(script.read_text().replace("#SBATCH --array=0-3", "#SBATCH --array=0-1"))
        with Slurm(pathlib.Path(place)) as slurm:
            made = slurm.run("sbatch", "--parsable", str(script))
            job = made.strip()
            expect(job.isdigit(), made)
            wait_for(lambda: len(foam_processes(scratch)) > 0, "a task", 30)
            time.sleep(0.3)
            victims = foam_processes(scratch)
            expect(victims, "no task runs\n" + slurm.run("squeue"))
            os.kill(victims[0], signal.SIGKILL)
            for other in victims[1:2]:
                with contextlib.suppress(ProcessLookupError):  # it may have ended meanwhile
                    os.kill(other, signal.SIGTERM)
            expect(wait_for(lambda: not foam_processes(scratch), "the tasks", 60), "tasks do not end")
            out, _ = foam("status", "array")
            print("after the signals:", out.splitlines()[0])
            for task in ("0", "1"):  # also one that has ended, as after the failure of a node
                print(slurm.run("scontrol", "requeue", f"{job}_{task}").strip() or f"task {task} is requeued")
            expect(wait_for(lambda: not slurm.states(job), "the tasks", 240), slurm.run("squeue"))
            expect(foam.table("array") == truth, "other bytes")
            log = (folder / "array/log-0.txt").read_text()
            expect("task 1 of 2 of a Slurm job array: 2 of 4 shards" in log, log)
            print(slurm.run("scontrol", "--version").strip() + f": {MESHES} meshes, 4 shards, 2 tasks: the same bytes")


main()
