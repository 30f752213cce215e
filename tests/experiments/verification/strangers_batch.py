# SPDX-FileCopyrightText: 2026 The ofg authors
#
# SPDX-License-Identifier: MIT

"""Says commands one after another in one process and writes down what came of each, line by line:
what is missing at the end crashed.

Usage: strangers_batch.py JOBS RESULTS. A job is the words of a command of ofg-bench, or ["mesh",
path].
"""

import contextlib
import io
import json
import sys
import traceback
import warnings

from experiments.cli import app
from ofg import Body, BodyError


def done(words: list[str]) -> dict:
    out, err = io.StringIO(), io.StringIO()
    code, trace = None, ""
    with (
        contextlib.redirect_stdout(out),
        contextlib.redirect_stderr(err),
        warnings.catch_warnings(),
    ):
        warnings.simplefilter("ignore")
        try:
            if words[0] == "mesh":
                Body.from_file(words[1])
                code = 0
            else:
                sys.argv = ["ofg-bench", *words]
                app.main()
        except SystemExit as end:
            code = end.code
        except BodyError as error:
            code = 2
            err.write(str(error))
        except BaseException:
            trace = traceback.format_exc()
    return {
        "words": words,
        "code": code,
        "out": out.getvalue(),
        "err": err.getvalue(),
        "trace": trace,
    }


if __name__ == "__main__":
    with open(sys.argv[1]) as jobs, open(sys.argv[2], "w", buffering=1) as results:
        for job in json.load(jobs):
            results.write(json.dumps(done(job)) + "\n")
