"""`cqltl keys`: make, list and remove API keys."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Any

from service.keys import SCOPES, KeysError, add_key, read_keys, remove_key
from service.settings import Settings

DEFAULT_SCOPES = "read,translate,plan"
"""What a robot needs."""


def add_keys_command(commands: Any) -> None:
    """Add `keys` to the subcommands of the command line."""
    parser = commands.add_parser("keys", help="API keys: who may use the service for what")
    actions = parser.add_subparsers(dest="action", required=True)
    add = actions.add_parser("add", help="make a key; it is printed once")
    add.add_argument("name", help="whose it is")
    add.add_argument("--scopes", type=_scopes, default=_scopes(DEFAULT_SCOPES), help=f"default: {DEFAULT_SCOPES}")
    listing = actions.add_parser("list", help="names and scopes")
    remove = actions.add_parser("remove", help="a key that is not to be good for anything any more")
    remove.add_argument("name")
    for action in (add, listing, remove):
        action.add_argument("--file", type=Path, help="where keys are kept, hashed (CQLTL_API_KEYS_FILE)")


def keys(settings: Settings, options: argparse.Namespace) -> int:
    """Run the command; the exit status."""
    path = options.file or settings.api_keys_file
    if path is None:
        print("where are the keys? --file, or CQLTL_API_KEYS_FILE", file=sys.stderr)
        return 2
    try:
        if options.action == "add":
            print(add_key(path, options.name, options.scopes))
        elif options.action == "remove":
            remove_key(path, options.name)
        else:
            for key in read_keys(path).values():
                print(key.name, ",".join(scope for scope in SCOPES if scope in key.scopes))
    except KeysError as error:
        print(error, file=sys.stderr)
        return 1
    return 0


def _scopes(text: str) -> list[str]:
    found = [scope.strip() for scope in text.split(",")]
    if not set(found) <= set(SCOPES):
        raise argparse.ArgumentTypeError(f"scopes are {', '.join(SCOPES)}, with commas between")
    return found
