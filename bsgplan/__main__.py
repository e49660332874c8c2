"""`python -m bsgplan`: the command line."""

from .cli import main

raise SystemExit(main())
