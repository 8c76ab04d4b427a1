"""The notebook of the guide in Jupyter's own kernel, with the installed foam: it ends in a picture and a proof.

notebook_from_wheel.py NOTEBOOK FOLDER   executes it in the folder, by nbclient
"""
import base64
import re
import sys

import nbclient
import nbformat


def main(file, folder):
    notebook = nbformat.read(file, as_version=4)
    nbclient.NotebookClient(notebook, timeout=300, kernel_name="python3", resources={"metadata": {"path": folder}}).execute()
    shown = [output["data"] for cell in notebook.cells if cell.cell_type == "code" for output in cell.outputs if "data" in output]
    assert any("certified" in data.get("text/plain", "") for data in shown), shown
    pictures = [data.get("image/png") or "".join(re.findall(r"data:image/png;base64,([^\"']+)", data.get("text/html", "")))
                for data in shown]
    assert any(base64.b64decode(picture)[:8] == b"\x89PNG\r\n\x1a\n" for picture in pictures if picture), "no picture"


if __name__ == "__main__":
    main(*sys.argv[1:])
