# docker build -t foam . && docker run --rm -v "$PWD:/work" -w /work foam run configs/panda_22.yaml
FROM debian:12-slim

WORKDIR /opt/foam
COPY dependencies.txt .
RUN apt-get update \
    && awk '/^## /{group = $2} !/^#/ && (group == "run:" || group == "run-12:" || group == "python:") {print $1}' dependencies.txt \
    | xargs apt-get install -y --no-install-recommends \
    && rm -rf /var/lib/apt/lists/*

COPY . .
RUN FOAM_NO_INSTALL=1 ./foam version && ./foam python -c 'import foam'

ENTRYPOINT ["/opt/foam/build/release/bin/foam"]
