"""The laboratory's commands of ``aegis-ot``: entry points of the group ``aegis_ot.commands``."""
