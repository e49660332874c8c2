"""`python -m bsgplan.cli` is `bsgplan`."""

from .app import main

raise SystemExit(main())
