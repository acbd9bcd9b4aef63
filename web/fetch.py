#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Puts what the report's page needs into web/node_modules, as package-lock.json has it, without npm:
that is many times as large as all that it would fetch. What tests need in addition, `npm ci` installs.
"""

import base64
import hashlib
import io
import json
import os
import sys
import tarfile
import urllib.request

WEB = os.path.dirname(os.path.abspath(__file__))
REGISTRY = os.environ.get("npm_config_registry", "https://registry.npmjs.org").rstrip("/")


def needed(lock):
    """(path below web/, name, version, integrity) of each package that is not for tests alone."""
    for path, package in lock["packages"].items():
        if path and not package.get("dev"):
            yield path, path.rpartition("node_modules/")[2], package["version"], package["integrity"]


def fetch(name, version, integrity):
    """The package's archive; an error if it is not the one in the lock file."""
    url = f"{REGISTRY}/{name}/-/{name.rpartition('/')[2]}-{version}.tgz"
    with urllib.request.urlopen(url, timeout=60) as answer:
        archive = answer.read()
    algorithm, _, expected = integrity.partition("-")
    found = base64.b64encode(hashlib.new(algorithm, archive).digest()).decode()
    if found != expected:
        raise OSError(f"{url}: expected {algorithm} {expected}, found {found}")
    return archive


def unpack(archive, folder):
    """What lies in the archive's one folder, files alone."""
    with tarfile.open(fileobj=io.BytesIO(archive), mode="r:gz") as files:
        for member in files:
            path = os.path.normpath(os.path.join(folder, member.name.partition("/")[2]))
            if not member.isfile() or not path.startswith(folder + os.sep):
                continue
            os.makedirs(os.path.dirname(path), exist_ok=True)
            with open(path, "wb") as file:
                file.write(files.extractfile(member).read())


def main():
    with open(os.path.join(WEB, "package-lock.json"), encoding="utf-8") as file:
        lock = json.load(file)
    try:
        for path, name, version, integrity in needed(lock):
            unpack(fetch(name, version, integrity), os.path.join(WEB, path))
    except OSError as problem:
        sys.exit(f"web/fetch.py: error: {problem}\nCheck the connection, or install npm and run `npm ci` in web/")


if __name__ == "__main__":
    main()
