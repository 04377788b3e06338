// Starts the language server and hands it the texts of domains; all it knows is in `casper lsp`.
const { workspace } = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

let client;

function activate() {
  const [command, ...args] = workspace.getConfiguration("casper").get("command");
  const server = { command, args };
  const texts = {
    documentSelector: [{ language: "casper" }],
    synchronize: { fileEvents: workspace.createFileSystemWatcher("**/*.pl") },
  };
  client = new LanguageClient("casper", "CASPER domains", server, texts);
  return client.start();
}

function deactivate() {
  return client ? client.stop() : undefined;
}

module.exports = { activate, deactivate };
